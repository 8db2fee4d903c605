// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/run_page.hpp"

namespace orca::supervisor {

/// Judges by their heartbeats which host processes hang.
///
/// It counts only time in which the supervisor itself has run: if its looks come late, because it was stopped or the
/// computer slept, a process is silent for one step only, however long the gap was. Nor does time count in which a process
/// could have run and had no processor. A process is judged from its first beat on; the time limit of the start holds before.
///
/// Thread contract: one thread.
class Heartbeats {
 public:
  static constexpr Duration kDefaultLimit = 500ms;

  /// Returns for how long [s] the thread of a process whose heart is to beat has waited for a processor, from its beginning until
  /// now. It is asked of a process that is silent.
  using Waited = std::function<Duration(std::size_t process)>;

  /// @param page  must outlive this object.
  explicit Heartbeats(const RunPage& page, Waited waited = nullptr)
      : page_(page), waited_(std::move(waited)), watched_(page.processes()) {}

  /// Watches a process that is about to be started.
  /// @param limit  [s] silence that counts as a hang, > 0.
  /// @pre  process < page.processes(), and nothing else beats for it.
  void watch(std::size_t process, Duration limit = kDefaultLimit);
  /// Watches a process that works already, and is judged at once.
  /// @param limit  as above.
  /// @pre  process < page.processes().
  void watch_working(std::size_t process, Duration limit = kDefaultLimit);
  /// Watches a process no longer, because it is ending or has ended.
  void forget(std::size_t process);

  /// Looks at all heartbeats.
  /// @return the processes that have been silent for their limit. Each is named once.
  [[nodiscard]] std::vector<std::size_t> look(Moment now);
  /// Returns the processes that have had no processor for their limit, and for how long, at the end of that. Each wait is told
  /// once.
  [[nodiscard]] std::vector<std::pair<std::size_t, Duration>> take_starved();
  /// Returns when to look next; nothing if no process is watched. A later look finds a hang later.
  [[nodiscard]] std::optional<Moment> due() const;

 private:
  // A process that is watched.
  struct Watched {
    Duration limit;
    std::uint32_t seen = 0;            // 0: it has not begun
    Duration silent{0};                // since the last change, as far as it counts
    std::optional<Duration> waited{};  // until the last look, since it is silent
    Duration starved{0};               // of the silence
  };
  static Duration step_of(const Watched& process);
  void note_beat(std::size_t place, Watched& process, std::uint32_t beats);
  [[nodiscard]] Duration starved_of(std::size_t place, Watched& process, Duration step) const;

  const RunPage& page_;
  const Waited waited_;
  std::vector<std::pair<std::size_t, Duration>> starved_;  // to be told
  std::vector<std::optional<Watched>> watched_;            // by process
  Moment last_look_{};
};

}  // namespace orca::supervisor
