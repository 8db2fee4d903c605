// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "member.hpp"
#include "orca/base/log.hpp"
#include "orca/base/mutex.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// Tells those host processes that wish it what all others and the supervisor write to the log. It keeps a bounded number of
/// lines, and a process that does not read, or a flood of lines, costs lines: how many, a line of its own says.
///
/// Thread contract: the supervisor's thread; lines are noted on any.
class LogRelay {
 public:
  static constexpr std::size_t kMostLines = 1000;    ///< That are kept for those who wish them.
  static constexpr std::size_t kMostAtOnce = 100;    ///< That a process is told at a time.
  static constexpr std::size_t kLongestLine = 2000;  ///< [bytes]; the middle of a longer one is left out.

  LogRelay();

  /// Notes whether a process wishes to hear the others. It hears what was written since the last of those who wished that was told
  /// something, or since the start.
  void note_wish(const Member& member, bool is_wished);
  /// Says which process the lines come from that are written from now on; null: the supervisor itself.
  void set_source(const Member* source);

  /// Passes on what was written. Call it often.
  /// @param members  those of all processes.
  void pass_on(const Members& members);
  /// Returns what a process is to be told next; nothing if it does not wish it.
  [[nodiscard]] TellLines take_for(const Member& member);

 private:
  struct Entry {
    std::uint64_t number;
    const Member* source;
    LogLine line;
  };

  void note(const log::Line& line);

  Mutex mutex_;
  std::map<const Member*, std::uint64_t> told_
      ORCA_GUARDED_BY(mutex_);                           // by who wishes them: the number of the last line
  std::deque<Entry> entries_ ORCA_GUARDED_BY(mutex_);    // the oldest first
  std::uint64_t last_ ORCA_GUARDED_BY(mutex_) = 0;       // number
  std::uint64_t most_told_ ORCA_GUARDED_BY(mutex_) = 0;  // number of the last line that anybody was told
  const Member* source_ ORCA_GUARDED_BY(mutex_) = nullptr;

  const log::Listener listener_ ORCA_GUARDED_BY(mutex_);  // the last member: it uses the others
};

}  // namespace orca::supervisor
