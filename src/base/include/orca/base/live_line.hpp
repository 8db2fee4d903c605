// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string_view>

namespace orca {

/// The last line of a terminal, which the program rewrites again and again. There is one in a process. Everything
/// else that Orca writes to a terminal makes room for it with a Pause, so that the two do not mix.
///
/// Thread contract: any thread; also in signal handlers where it says so.
class LiveLine {
 public:
  /// A time in which the line is not there, because somebody else writes. Several may overlap.
  class Pause {
   public:
    Pause();
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;
  };

  /// Shows a text in place of the one before. Does nothing during a Pause, after erase_for_good(), and while the
  /// terminal takes no output (Ctrl-S); it never waits.
  /// @param terminal  a descriptor that stays open.
  /// @param text      printable, and shorter than the terminal is wide.
  static void show(int terminal, std::string_view text);

  /// Calls `changed` with true when a Pause begins and there is no other, and with false when the last one ends; null: not
  /// any more. For a process whose terminal shows the line of another one.
  /// @param changed  is called on the thread of the Pause. It must not make a Pause itself.
  static void on_pause(std::function<void(bool begins)> changed);

  /// Erases the line.
  static void erase();

  /// Erases the line, and shows none any more: the process is about to end. May be called in a signal handler.
  static void erase_for_good() noexcept;
};

}  // namespace orca
