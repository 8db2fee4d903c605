// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/run_page.hpp"

namespace orca::supervisor {

/// Judges by their heartbeats which host processes hang.
///
/// It counts only time in which the supervisor itself has run: if its looks come late, because it was stopped or the
/// computer slept, a process is silent for one step only, however long the gap was. A process is judged from its first
/// beat on; the time limit of the start holds before.
///
/// Thread contract: one thread.
class Heartbeats {
 public:
  static constexpr Duration kDefaultLimit = 500ms;

  /// @param page  must outlive this object.
  explicit Heartbeats(const RunPage& page) : page_(page), watched_(page.processes()) {}

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
  /// Returns when to look next; nothing if no process is watched. A later look finds a hang later.
  [[nodiscard]] std::optional<Moment> due() const;

 private:
  // A process that is watched.
  struct Watched {
    Duration limit;
    std::uint32_t seen = 0;  // 0: it has not begun
    Duration silent{0};      // since the last change, as far as it counts
  };
  static Duration step_of(const Watched& process);

  const RunPage& page_;
  std::vector<std::optional<Watched>> watched_;  // by process
  Moment last_look_{};
};

}  // namespace orca::supervisor
