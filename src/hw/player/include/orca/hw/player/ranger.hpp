// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "orca/hw/player/geometry.hpp"
#include "orca/hw/player/message.hpp"

/// Messages of the interface ranger.
namespace orca::hw::player {

/// RangerValues [m].
inline constexpr MessageId kRangerRanges{Interface::ranger, MessageType::data, 1};
/// RangerStamped.
inline constexpr MessageId kRangerStamped{Interface::ranger, MessageType::data, 2};
/// RangerValues: intensities, in units of the sensor.
inline constexpr MessageId kRangerIntensities{Interface::ranger, MessageType::data, 3};
/// Empty; answered by RangerGeometry.
inline constexpr MessageId kRangerAskGeometry{Interface::ranger, MessageType::request, 1};
/// RangerConfig.
inline constexpr MessageId kRangerSetConfig{Interface::ranger, MessageType::request, 4};
/// Empty; answered by RangerConfig.
inline constexpr MessageId kRangerAskConfig{Interface::ranger, MessageType::request, 5};

struct RangerValues {
  static constexpr std::string_view kName = "ranger RANGE or INTNS";
  std::vector<double> values{};  ///< Counter-clockwise from RangerConfig::min_angle, or one per element.
  friend bool operator==(const RangerValues&, const RangerValues&) = default;
};

/// Where a ranger and its elements are. A laser scanner is one element.
struct RangerGeometry {
  static constexpr std::string_view kName = "ranger geometry";
  Pose3 pose{};
  Size3 size{};
  std::vector<Pose3> element_poses{};
  std::vector<Size3> element_sizes{};
  friend bool operator==(const RangerGeometry&, const RangerGeometry&) = default;
};

struct RangerConfig {
  static constexpr std::string_view kName = "ranger CONFIG";
  double min_angle = 0.0;           ///< [rad]
  double max_angle = 0.0;           ///< [rad]
  double angular_resolution = 0.0;  ///< [rad]
  double min_range = 0.0;           ///< [m]
  double max_range = 0.0;           ///< [m]
  double range_resolution = 0.0;    ///< [m]
  double frequency = 0.0;           ///< [Hz]
  friend bool operator==(const RangerConfig&, const RangerConfig&) = default;
};

/// Ranges, and what else was known when they were measured.
/// @source  Player's interface definition alone; its bytes were not seen on a line.
struct RangerStamped {
  static constexpr std::string_view kName = "ranger RANGESTAMPED";
  RangerValues ranges{};
  std::optional<RangerGeometry> geometry{};
  std::optional<RangerConfig> config{};
  friend bool operator==(const RangerStamped&, const RangerStamped&) = default;
};

}  // namespace orca::hw::player
