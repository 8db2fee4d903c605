// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "orca/hw/player/message.hpp"
#include "orca/hw/player/payload.hpp"

/// Messages of the interfaces sonar, laser, ranger, bumper and power.
namespace orca::hw::player {

// Sonar.

/// SonarRanges.
inline constexpr MessageId kSonarRanges{Interface::sonar, MessageType::data, 1};
/// Empty; answered by SonarGeometry.
inline constexpr MessageId kSonarAskGeometry{Interface::sonar, MessageType::request, 1};
/// Switch; the answer is empty.
inline constexpr MessageId kSonarPower{Interface::sonar, MessageType::request, 2};

struct SonarRanges {
  static constexpr std::string_view kName = "sonar RANGES";
  std::vector<float> ranges{};  ///< [m] one of each sonar, in the order of SonarGeometry.
  friend bool operator==(const SonarRanges&, const SonarRanges&) = default;
};

struct SonarGeometry {
  static constexpr std::string_view kName = "sonar geometry";
  std::vector<Pose3> poses{};  ///< In the robot frame; x is the axis of the cone.
  friend bool operator==(const SonarGeometry&, const SonarGeometry&) = default;
};

// Laser. Its numbers have single precision on the line, and so they have here.

/// LaserScan.
inline constexpr MessageId kLaserScan{Interface::laser, MessageType::data, 1};
/// Empty; answered by Geometry.
inline constexpr MessageId kLaserAskGeometry{Interface::laser, MessageType::request, 1};
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

// Ranger.

/// RangerValues [m].
inline constexpr MessageId kRangerRanges{Interface::ranger, MessageType::data, 1};
/// RangerStamped.
inline constexpr MessageId kRangerStamped{Interface::ranger, MessageType::data, 2};
/// Empty; answered by RangerGeometry.
inline constexpr MessageId kRangerAskGeometry{Interface::ranger, MessageType::request, 1};
/// Empty; answered by RangerConfig.
inline constexpr MessageId kRangerAskConfig{Interface::ranger, MessageType::request, 5};

struct RangerValues {
  static constexpr std::string_view kName = "ranger RANGE";
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

// Bumper.

/// BumperState.
inline constexpr MessageId kBumperState{Interface::bumper, MessageType::data, 1};

struct BumperState {
  static constexpr std::string_view kName = "bumper STATE";
  std::vector<std::uint8_t> pressed{};  ///< Of each bumper: 0 free, else pressed.
  friend bool operator==(const BumperState&, const BumperState&) = default;
};

// Power.

/// PowerState.
inline constexpr MessageId kPowerState{Interface::power, MessageType::data, 1};

/// State of a battery; what the server does not know is nothing.
struct PowerState {
  static constexpr std::string_view kName = "power STATE";
  std::optional<float> voltage{};          ///< [V]
  std::optional<float> charge{};           ///< [%] of a full battery.
  std::optional<float> energy{};           ///< [J] stored.
  std::optional<float> power{};            ///< [W] drawn.
  std::optional<std::int32_t> charging{};  ///< 1: it is being charged; 0: it is not.
  friend bool operator==(const PowerState&, const PowerState&) = default;
};

}  // namespace orca::hw::player
