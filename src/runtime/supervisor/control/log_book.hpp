// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <vector>

#include "members/reply.hpp"
#include "orca/base/log.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/time.hpp"

namespace orca::supervisor {

/// Which lines of the log a client wants. A plain value.
struct LogWish {
  log::Level level = log::Level::info;  ///< The lowest.
  std::vector<std::string> who{};       ///< Components, hardware or processes; none: all.
  bool follows = false;                 ///< Also those that are still to come.
};

/// The last lines of the log of all processes, and the clients that follow it. A client that does not read loses lines, and
/// is told how many.
///
/// Thread contract: the supervisor's thread; lines are noted on any.
class LogBook {
 public:
  static constexpr std::size_t kMost = 1000;  ///< Lines that are kept.
  static constexpr std::size_t kLongestLine =
      2000;  ///< [bytes] of a line; its middle is left out if it is longer.

  /// @param clock  the clock of the log.
  explicit LogBook(std::function<TimePoint()> clock);

  /// Answers with the lines that are kept; if the client follows, with those that come, until it is gone. A note names those that
  /// have no line.
  void show(LogWish wish, const ReplyPtr& reply);
  /// Passes on what was noted since the last call.
  void pass_on();
  /// Returns how many lines a second each has written lately: within ten seconds, or as far as lines are kept.
  [[nodiscard]] std::map<std::string, double> rates();

 private:
  struct Entry {
    std::uint64_t number;
    TimePoint time;
    log::Level level;
    std::string who;
    std::string text;
  };
  struct Follower {
    LogWish wish;
    ReplyPtr reply;
  };

  void note(const log::Line& line);
  static void tell(const Entry& entry, const LogWish& wish, Reply& reply);
  void note_absent(const LogWish& wish, Reply& reply) const ORCA_REQUIRES(mutex_);

  const std::function<TimePoint()> clock_;
  std::list<Follower> followers_;
  std::uint64_t passed_on_ = 0;  // number of the last line that followers have

  Mutex mutex_;
  std::deque<Entry> entries_ ORCA_GUARDED_BY(mutex_);  // the oldest first
  std::uint64_t last_ ORCA_GUARDED_BY(mutex_) = 0;     // number

  const log::Listener listener_;  // the last member: it uses the others
};

}  // namespace orca::supervisor
