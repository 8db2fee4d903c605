// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::hw::player {

/// Returns the bytes of a payload in XDR: big-endian, each member a multiple of 4 bytes, lists with their count twice.
///
/// Defined for the structures in the headers of the interfaces.
template <class Payload>
[[nodiscard]] std::vector<std::uint8_t> encode(const Payload& payload);

/// Reads a payload. Numbers are taken as they are: they may be infinite, not a number, or out of all proportion.
/// @errors  data_loss, with the name of the payload, if it is shorter or longer than its content says, if the two
///          counts of a list differ, if a list has more elements than bytes follow, or if an enumeration has an unknown
///          value. No memory is taken for elements that are not there.
template <class Payload>
[[nodiscard]] Result<Payload> decode(std::span<const std::uint8_t> bytes);

// Places and sizes in payloads. Axes: x forward, y left, z up; angles counter-clockwise.

/// A pose in space. A plain value.
struct Pose3 {
  double x = 0.0;      ///< [m]
  double y = 0.0;      ///< [m]
  double z = 0.0;      ///< [m]
  double roll = 0.0;   ///< [rad]
  double pitch = 0.0;  ///< [rad]
  double yaw = 0.0;    ///< [rad]
  friend bool operator==(const Pose3&, const Pose3&) = default;
};

/// The size of a box. A plain value.
struct Size3 {
  double width = 0.0;   ///< [m] along y.
  double length = 0.0;  ///< [m] along x.
  double height = 0.0;  ///< [m] along z.
  friend bool operator==(const Size3&, const Size3&) = default;
};

/// A pose in the plane, or a velocity along its axes; payload of position2d SET_ODOM.
struct Planar {
  static constexpr std::string_view kName = "pose in the plane";
  double x = 0.0;    ///< [m] or [m/s]
  double y = 0.0;    ///< [m] or [m/s]
  double yaw = 0.0;  ///< [rad] or [rad/s]
  friend bool operator==(const Planar&, const Planar&) = default;
};

/// Where a device is on its robot, and its size: answer to GET_GEOM of position2d and laser.
struct Geometry {
  static constexpr std::string_view kName = "geometry";
  Pose3 pose{};
  Size3 size{};
  friend bool operator==(const Geometry&, const Geometry&) = default;
};

/// State of a switch: motor power of position2d, power of sonar.
struct Switch {
  static constexpr std::string_view kName = "switch";
  bool on = false;
  friend bool operator==(const Switch&, const Switch&) = default;
};

}  // namespace orca::hw::player
