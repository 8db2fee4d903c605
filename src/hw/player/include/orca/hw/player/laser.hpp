// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "orca/hw/player/geometry.hpp"
#include "orca/hw/player/message.hpp"

/// Messages of the interface laser. Its numbers have single precision on the line, and so they have here.
namespace orca::hw::player {

/// LaserScan.
inline constexpr MessageId kLaserScan{Interface::laser, MessageType::data, 1};
/// LaserScanPose.
inline constexpr MessageId kLaserScanPose{Interface::laser, MessageType::data, 2};
/// Empty; answered by Geometry.
inline constexpr MessageId kLaserAskGeometry{Interface::laser, MessageType::request, 1};
/// LaserConfig.
inline constexpr MessageId kLaserSetConfig{Interface::laser, MessageType::request, 2};
/// Empty; answered by LaserConfig.
inline constexpr MessageId kLaserAskConfig{Interface::laser, MessageType::request, 3};

/// One turn of a scanner, counter-clockwise from min_angle.
struct LaserScan {
  static constexpr std::string_view kName = "laser SCAN";
  float min_angle = 0.0F;                   ///< [rad] of the first range; 0: forward.
  float max_angle = 0.0F;                   ///< [rad] of the last one.
  float resolution = 0.0F;                  ///< [rad] between ranges.
  float max_range = 0.0F;                   ///< [m]
  std::vector<float> ranges{};              ///< [m]
  std::vector<std::uint8_t> intensities{};  ///< Of the ranges, or none. Units of the scanner.
  std::uint32_t id = 0;                     ///< Counts scans.
  friend bool operator==(const LaserScan&, const LaserScan&) = default;
};

struct LaserScanPose {
  static constexpr std::string_view kName = "laser SCANPOSE";
  LaserScan scan{};
  Planar pose{};  ///< Of the scanner when it measured, in the frame of the odometry.
  friend bool operator==(const LaserScanPose&, const LaserScanPose&) = default;
};

struct LaserConfig {
  static constexpr std::string_view kName = "laser CONFIG";
  float min_angle = 0.0F;         ///< [rad]
  float max_angle = 0.0F;         ///< [rad]
  float resolution = 0.0F;        ///< [rad]
  float max_range = 0.0F;         ///< [m]
  float range_resolution = 0.0F;  ///< [m]
  bool with_intensity = false;
  float frequency = 0.0F;  ///< [Hz]
  friend bool operator==(const LaserConfig&, const LaserConfig&) = default;
};

}  // namespace orca::hw::player
