// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::log {

enum class Level { debug, info, warning, error, off };

/// Reads "debug", "info", "warning", "error" or "off".
[[nodiscard]] Result<Level> parse_level(std::string_view text);

/// Sets the lowest level that is written. Default: info.
void set_level(Level level);

/// Sets the clock that gives the time in front of each line. Without a clock (null) lines carry no time.
void set_clock(std::function<TimePoint()> now);

/// Writes one line to stderr: time [s], level, who, text. The text is made printable(), see text.hpp.
///
/// @thread  any; lines are not mixed.
void write(Level level, std::string_view who, std::string_view text);

/// A line of the log, valid during a call.
struct Line {
  Level level = Level::info;
  std::string_view who;
  std::string_view text;  ///< As it was written, not made printable().
  TimePoint time;         ///< By the clock of the log; 0 without a clock.
};

/// Hears every line of this process while it lives, also those below the level that is written.
class Listener {
 public:
  /// @param heard  is called with each line, for one line at a time, on the thread that writes it. It must not write
  ///               to the log itself.
  explicit Listener(std::function<void(const Line&)> heard);
  /// After it no call is under way.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

 private:
  friend void write(Level level, std::string_view who, std::string_view text);
  std::function<void(const Line&)> heard_;
};

inline void debug(std::string_view who, std::string_view text) { write(Level::debug, who, text); }
inline void info(std::string_view who, std::string_view text) { write(Level::info, who, text); }
inline void warning(std::string_view who, std::string_view text) { write(Level::warning, who, text); }
inline void error(std::string_view who, std::string_view text) { write(Level::error, who, text); }

}  // namespace orca::log
