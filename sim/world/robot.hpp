// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bumper_model.hpp"
#include "drive_model.hpp"
#include "infrared_model.hpp"
#include "laser_model.hpp"
#include "odometry_model.hpp"
#include "orca/base/hash.hpp"
#include "orca/sim/scene.hpp"
#include "sonar_model.hpp"

namespace orca::sim::detail {

// One robot of a running world: its model and everything about it that changes, but for what Physics and the
// Caster keep.
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

  // The base has moved to `X_WB` in the tick that ended at `now`; `blocked`: something was in its way.
  void moved(const Pose2& X_WB, TimePoint now, bool blocked);
  // Lets the sonars fire. @pre  moved() was called for all robots.
  void chirp(SonarAir& air, std::size_t own_body);
  // Lets the sensors measure, in the world as it is now. @pre  chirp() was called for all robots.
  void sense(const Caster& caster, const SonarAir& air, std::size_t own_body);
  // Lets the bumpers feel what touches the robot now.
  void feel(std::span<const Touch> touches);

  [[nodiscard]] SceneRobot drawn() const;
  void add_to(Fnv1a& hash) const;

  const std::string name;
  const RobotModel model;
  DriveModel drive;
  Velocity driving;   // Of the drive, in the present tick.
  Velocity velocity;  // True, in the last tick.
  Pose2 pose;
  std::vector<SonarModel> sonars;
  std::vector<LaserModel> lasers;
  std::vector<InfraredModel> infrareds;
  std::vector<BumperModel> bumpers;
  std::optional<OdometryReading> odometry;  // Set in the tick in which it is due.

 private:
  void sample(TimePoint now);

  Duration tick_;
  OdometryModel odometry_model_;
  TickSpan last_tick_;
  TimePoint odometry_due_;
  std::vector<SceneRobot::Sample> trajectory_;
};

}  // namespace orca::sim::detail
