// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "orca/geometry/pose2.hpp"

namespace orca::dock {

/// The manner in which a robot docks.
struct Manner {
  double speed = 0.0;     ///< [m/s] at which it touches the contacts.
  double back_off = 0.0;  ///< [m] by which it drives back from them.
  double patience = 0.0;  ///< [s] for which it stands at them and waits until it is charged.
  double attempts = 1.0;  ///< [1] after which it has failed.
};

/// The result of one lap.
struct Step {
  enum class Kind { goes_on, done, failed };
  Kind kind = Kind::goes_on;
  double speed = 0.0;      ///< [m/s]
  double turn_rate = 0.0;  ///< [rad/s]
  std::string reason{};    ///< Why it has failed, for people.
};

/// The last part of the way to a charger: the robot turns to the contacts, creeps along their axis until something holds it, stands and looks whether it is
/// charged. If it is not, it drives back and tries once more.
///
/// Thread contract: not synchronised.
class Docking {
 public:
  /// Goes on for one lap.
  /// @param robot    its pose in the frame of the contacts: they are at the origin, and x leads into them.
  /// @param charges  whether its battery is charged.
  /// @param time [s]  of a clock that only advances.
  [[nodiscard]] Step step(const Pose2& robot, bool charges, double time, const Manner& manner);

  /// Puts off all that waits, because the motors were held [s].
  void delay(double time);

  /// Returns all of it, to be passed on to another version of the component.
  auto state() { return std::tie(stage_, attempt_, began_, from_, held_since_); }

 private:
  enum class Stage { approach, look, back_off };

  [[nodiscard]] Step approach(const Pose2& robot, double time, double speed);
  [[nodiscard]] Step look(const Pose2& robot, bool charges, double time, const Manner& manner);
  [[nodiscard]] Step back_off(const Pose2& robot, double time, const Manner& manner);
  [[nodiscard]] Step enter(Stage stage, const Pose2& robot, double time);
  [[nodiscard]] bool is_held(const Pose2& robot, double time);

  Stage stage_ = Stage::approach;
  double attempt_ = 1.0;
  std::optional<double> began_{};  // [s] the present stage
  Vec2 from_{};                    // where that was, or where the robot was last seen to move
  double held_since_ = 0.0;        // [s]
};

}  // namespace orca::dock
