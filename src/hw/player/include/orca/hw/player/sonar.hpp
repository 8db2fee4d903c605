// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "orca/hw/player/geometry.hpp"
#include "orca/hw/player/message.hpp"

/// Messages of the interface sonar.
namespace orca::hw::player {

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

}  // namespace orca::hw::player
