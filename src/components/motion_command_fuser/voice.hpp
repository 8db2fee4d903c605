// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace orca::fuse {

/// The movement that one behaviour wants.
struct Wish {
  enum class Kind { direction, turn_rate };
  Kind kind = Kind::direction;
  double value = 0.0;   ///< Direction [rad] or turn rate [rad/s], counter-clockwise positive.
  double speed = 0.0;   ///< [m/s]
  double weight = 0.0;  ///< [1] above 0.
  double left = 0.0;    ///< [m/s] sideways, for a base that can move so.
};

/// The one command that several wishes result in.
struct Fused {
  Wish command;                ///< Its weight is the sum of those that made it.
  std::vector<double> shares;  ///< [1] of each wish in it, in their order; the sum is 1.
  double agreement = 1.0;      ///< [1] The part of their speeds that is left where wishes cancel out.
};

/// The last message of a behaviour that the fuser listens to.
struct Voice {
  enum class Said { nothing, dont_care, full_stop, wish };

  std::string name;
  Said said = Said::nothing;                                  ///< Last of all.
  double age = std::numeric_limits<double>::infinity();       ///< [s] since then.
  Wish wish = {};                                             ///< The last one, if it ever had one.
  double wish_age = std::numeric_limits<double>::infinity();  ///< [s] since then.
  /// [s] silence of this behaviour that stops the robot; infinity: it may be silent.
  double silence_limit = std::numeric_limits<double>::infinity();
  bool lost = false;  ///< It fell silent, and does not speak regularly again yet.
};

/// The reliability of a behaviour. One that has fallen silent is relied upon again once it has spoken in time
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
