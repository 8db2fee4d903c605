// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "orca/hw/player/geometry.hpp"
#include "orca/hw/player/laser.hpp"
#include "orca/hw/player/message.hpp"
#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sonar.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::player_server {

/// A robot as clients of Player see it: its devices, and the latest of each in Player's form.
///
/// Thread contract: not synchronised.
struct RobotFace {
  /// Returns the devices that the robot has: position2d always, sonar and laser if it has said something of them.
  [[nodiscard]] std::vector<hw::player::Interface> devices() const;

  hw::player::Size3 size{};  ///< Of the robot; 0: not known.
  std::optional<hw::player::Position2dState> state{};
  std::optional<hw::player::SonarRanges> sonar{};
  hw::player::SonarGeometry sonar_poses{};
  std::optional<hw::player::LaserScan> scan{};
  hw::player::Pose3 laser_pose{};
  hw::player::LaserConfig laser_config{};
  /// Whether there are ports for these, even if nothing has come yet.
  bool has_sonar = false;
  bool has_laser = false;

  void take(const idl::Odometry& odometry);
  void take(const idl::SonarRangeReadings& readings);
  void take(const idl::LaserRangeReadings& readings);

 private:
  std::uint32_t scans_ = 0;
};

}  // namespace orca::player_server
