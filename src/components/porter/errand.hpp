// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "orca/geometry/pose2.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::porter {

/// The manner in which the robot works with its gripper.
struct Manner {
  double reach = 0.0;  ///< [m] from the middle of the robot to the inner beam, where the paddles hold things.
  double approach_speed = 0.0;  ///< [m/s]
  double turn_rate = 0.0;       ///< [rad/s] of turns on the spot.
  double back_off = 0.0;        ///< [m] by which it drives back from what it has put down.
  double patience = 0.0;        ///< [s] for each step, after which the errand has failed.
};

/// The motion that the robot should make now.
struct Wish {
  double direction = 0.0;  ///< [rad] robot frame, positive to the left; used while it drives.
  double turn_rate = 0.0;  ///< [rad/s] used while it stands.
  double speed = 0.0;      ///< [m/s]
};

/// The result of one lap.
struct Step {
  enum class Kind { goes_on, done, failed };
  Kind kind = Kind::goes_on;
  Wish wish{};
  std::optional<idl::GripperCommand> gripper{};  ///< The command to the gripper.
  std::string reason{};                          ///< Why it has failed, for people.
};

/// The work at a place that the robot has come near to: it fetches the thing that stands there, or puts down the one that it
/// holds. It turns to the place, drives straight up to it, and works with the gripper; then it has the thing lifted, or has
/// driven back from it.
///
/// A command to the gripper is said again each second until it is carried out, since the driver may have been exchanged.
///
/// Thread contract: not synchronised.
class Errand {
 public:
  enum class Kind { fetch, put };

  Errand() = default;
  /// @param place [m]  in the frame of the robot's pose.
  Errand(Kind kind, Vec2 place)
      : kind_(kind), place_(place), stage_(kind == Kind::fetch ? Stage::open : Stage::look) {}

  /// Goes on for one lap.
  /// @param pose  of the robot now.
  /// @param time [s]  of a clock that only advances.
  [[nodiscard]] Step step(const Pose2& pose, const idl::GripperState& gripper, double time,
                          const Manner& manner);

  /// Puts off the end of its patience, because the motors were held [s].
  void delay(double time);

  /// Returns all of it, to be passed on to another version of the component.
  auto state() { return std::tie(kind_, place_, stage_, began_, told_, from_); }

 private:
  /// To fetch: open, turn, approach, close, lift. To put down: look, turn, approach, lower, let_go, back_off.
  enum class Stage { open, look, turn, approach, close, lift, lower, let_go, back_off };

  struct Scene {
    const Pose2& pose;
    const idl::GripperState& gripper;
    double time;
    const Manner& manner;
  };

  [[nodiscard]] Step fetch(const Scene& now);
  [[nodiscard]] Step put(const Scene& now);
  [[nodiscard]] Step turn(const Scene& now);
  [[nodiscard]] Step approach_thing(const Scene& now);
  [[nodiscard]] Step approach_place(const Scene& now);
  [[nodiscard]] Step close(const Scene& now);
  [[nodiscard]] Step back_off(const Scene& now);
  [[nodiscard]] Step tell(const Scene& now, idl::PaddleMotion paddles, idl::LiftMotion lift);
  [[nodiscard]] Step enter(Stage stage);
  [[nodiscard]] const char* late() const;

  Kind kind_ = Kind::fetch;
  Vec2 place_{};
  Stage stage_ = Stage::open;
  std::optional<double> began_{};  // [s] the present stage
  std::optional<double> told_{};   // [s] when the gripper was commanded last
  Vec2 from_{};                    // where the present stage began
};

}  // namespace orca::porter
