// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::fuse {

/// Whether a behaviour may be relied upon. One that has fallen silent may be so again once it has spoken in time
/// kTimely times in a row: a robot that drove on each word of a behaviour that is dying would drive blindly in
/// between.
class Reliance {
 public:
  static constexpr int kTimely = 3;

  /// Notes a message.
  /// @param gap    [s] since the one before it; infinity for the first.
  /// @param limit  [s] silence of the behaviour that stops the robot.
  void heard(double gap, double limit) {
    timely_ = gap <= limit ? timely_ + 1 : 0;
    if (timely_ >= kTimely) lost_ = false;
  }
  /// Notes for how long nothing has been heard since the last message [s].
  void look(double age, double limit) {
    if (age <= limit) return;
    lost_ = true;
    timely_ = 0;
  }
  [[nodiscard]] bool is_lost() const { return lost_; }

 private:
  bool lost_ = false;
  int timely_ = 0;
};

}  // namespace orca::fuse
