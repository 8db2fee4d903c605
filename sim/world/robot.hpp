// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "motion/drive_model.hpp"
#include "motion/gripper_model.hpp"
#include "motion/odometry_model.hpp"
#include "motion/turret_model.hpp"
#include "motion/wheel_model.hpp"
#include "orca/base/hash.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/sim/floor.hpp"
#include "orca/sim/snapshot.hpp"
#include "robot_sensors.hpp"

namespace orca::sim::detail {

// Where a robot has been, for pictures: one pose per step of way or turn. The steps double whenever there are too many
// poses, so that a run of any length takes no more memory (512 KiB) than that.
class Trail {
 public:
  static constexpr std::size_t kMost = 16384;  // Poses.

  explicit Trail(const RobotSnapshot::Sample& first) : samples_{first} {}

  // Keeps the pose if it is a step away from the last one that was kept.
  void add(const RobotSnapshot::Sample& now);

  [[nodiscard]] const std::vector<RobotSnapshot::Sample>& samples() const { return samples_; }

 private:
  void thin_out();

  double way_ = 0.05;  // [m] Of one step.
  double turn_ = 0.2;  // [rad] Of one step.
  std::vector<RobotSnapshot::Sample> samples_;
};

// A robot of a running world: its model and its changing state, except what Physics and the Caster keep.
class Robot {
 public:
  struct Birth {
    std::string name;
    Pose2 X_WB;
    TimePoint time;
    std::uint64_t seed;
    Duration tick;
  };
  Robot(Birth birth, RobotModel model, const ErrorLevels& errors);

  // Starts the motion of a tick. @return  the motion of the robot's frame if nothing is in its way.
  Travel2 set_off(const Floor& floor);
  // Returns the part of that turn [rad] which turns the body.
  [[nodiscard]] double body_turn(const Travel2& set_off) const {
    return steers() ? set_off.turn - driving_.turn_rate * to_seconds(tick_) : set_off.turn;
  }
  // Reports that the body has moved to `X_WB` in the tick that ended at `now`. `blocked` is true if something
  // was in its way.
  void moved(const Pose2& X_WB, TimePoint now, bool blocked);
  // Puts the body at `X_WB` at the time `now`, at rest. Wheels, odometry and turret notice nothing.
  void put(const Pose2& X_WB, TimePoint now);
  [[nodiscard]] double speed() const { return portable::hypot(driving_.forward, driving_.left); }  // [m/s]
  [[nodiscard]] std::optional<TurretReading> turret() const;
  void keep_trail() { trail_.emplace(RobotSnapshot::Sample{carriers.body.to, pose}); }
  [[nodiscard]] RobotSnapshot drawn() const;
  void add_to(Fnv1a& hash) const;

  const std::string name;
  const RobotModel model;
  DriveModel drive;
  std::optional<GripperModel> gripper;
  Twist2 velocity;  // True velocity in the last tick, in the robot's frame.
  Pose2 pose;       // Pose of the robot's frame: x is forward.
  Pose2 body;       // Equals `pose` except on a synchro base, whose body does not turn with its wheels.
  RobotSensors sensors;
  Carriers carriers;                        // Of the sensors.
  std::optional<OdometryReading> odometry;  // Set in the tick in which it is due.

 private:
  [[nodiscard]] bool steers() const { return model.drive.kind == DriveKind::synchro; }
  [[nodiscard]] Footing footing(const Floor& floor) const;
  void reckon(const Travel2& rolled, TimePoint now);
  void carry(const Pose2& X_WB, const Pose2& X_WR, TimePoint now);
  [[nodiscard]] Pose2 turret_pose(const Pose2& X_WB) const;

  Duration tick_;
  RandomStream slip_;
  WheelModel wheels_;
  Twist2 driving_;      // Velocity of the drive in the present tick, as its encoders see it.
  double steer_ = 0.0;  // [rad] Angle of the wheels relative to the body.
  std::optional<TurretModel> turret_;
  OdometryModel odometry_model_;
  TimePoint odometry_due_;
  std::optional<Trail> trail_;  // Only if somebody draws it.
};

// Returns the first robot that stands where the body is and reaches below its top, or null.
[[nodiscard]] const Robot* robot_at(const std::deque<Robot>& robots, const Body& body);

}  // namespace orca::sim::detail
