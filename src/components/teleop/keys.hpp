// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>
#include <utility>

namespace orca::teleop {

/// The position of the controls, each in [-1, 1]: forward positive, and left positive.
struct Stick {
  double forward = 0.0;
  double left = 0.0;
  friend bool operator==(const Stick&, const Stick&) = default;
};

/// The keys of a terminal: arrows or W A S D drive, the space bar stops, P asks for the position, Q ends. A terminal reports a key
/// again and again while it is held, but never its release. So each press counts until the dead-man time has
/// passed.
///
/// Thread contract: not synchronised.
class Keys {
 public:
  /// Takes bytes as the terminal sends them; escape sequences may come in parts.
  /// @param time  [s] now.
  void take(std::string_view bytes, double time);

  /// @param dead_man  [s] time that a press counts.
  [[nodiscard]] Stick stick(double time, double dead_man) const;
  [[nodiscard]] bool quit() const { return quit_; }
  /// Returns whether the position was asked for since the last call.
  [[nodiscard]] bool take_question() { return std::exchange(asked_, false); }

 private:
  struct Press {
    double direction = 0.0;
    double time = 0.0;  // [s]
    [[nodiscard]] double at(double now, double dead_man) const;
  };
  void press(char key, double time);

  enum class Escape { none, begun, bracket } escape_ = Escape::none;
  Press forward_;
  Press left_;
  bool asked_ = false;
  bool quit_ = false;
};

}  // namespace orca::teleop
