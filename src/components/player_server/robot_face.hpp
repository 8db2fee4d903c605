// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "orca/hw/player/message.hpp"
#include "orca/hw/player/payload.hpp"
#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::player_server {

/// A device, as clients name it.
struct DeviceName {
  hw::player::Interface interface = hw::player::Interface::position2d;
  std::uint32_t index = 0;
  friend auto operator<=>(const DeviceName&, const DeviceName&) = default;
};

// Each sensor has two names: that of old programs, and that as a ranger.
inline constexpr DeviceName kBase{hw::player::Interface::position2d, 0};
inline constexpr DeviceName kSonar{hw::player::Interface::sonar, 0};
inline constexpr DeviceName kLaser{hw::player::Interface::laser, 0};
inline constexpr DeviceName kSonarRanger{hw::player::Interface::ranger, 0};
inline constexpr DeviceName kLaserRanger{hw::player::Interface::ranger, 1};

/// A robot as clients of Player see it: its devices, and the latest of each in Player's form.
///
/// Thread contract: not synchronised.
struct RobotFace {
  /// Returns the devices that the robot has: position2d always; sonar and ranger:0, laser and ranger:1 if there are ports for them.
  [[nodiscard]] std::vector<DeviceName> devices() const;

  hw::player::Size3 size{};  ///< The robot's; 0: not known.
  std::optional<hw::player::Position2dState> state{};
  std::optional<hw::player::SonarRanges> sonar{};
  hw::player::SonarGeometry sonar_poses{};
  double sonar_lobe = 0.0;   ///< [rad] in which one hears.
  double sonar_range = 0.0;  ///< [m] longest.
  std::optional<hw::player::LaserScan> scan{};
  hw::player::Pose3 laser_pose{};
  hw::player::LaserConfig laser_config{};
  /// Whether there are ports for these, even if nothing has come yet.
  bool has_sonar = false;
  bool has_laser = false;

  void take(const idl::Odometry& odometry);
  void take(const idl::SonarRangeReadings& readings);
  void take(const idl::LaserRangeReadings& readings);

  /// Return what clients of a ranger ask. @param ranger  kSonarRanger or kLaserRanger.
  [[nodiscard]] hw::player::RangerGeometry ranger_geometry(const DeviceName& ranger) const;
  [[nodiscard]] hw::player::RangerConfig ranger_config(const DeviceName& ranger) const;
  /// Returns its latest ranges; nothing if there are none yet.
  [[nodiscard]] std::optional<hw::player::RangerValues> ranger_values(const DeviceName& ranger) const;

 private:
  std::uint32_t scans_ = 0;
};

}  // namespace orca::player_server
