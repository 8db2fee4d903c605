// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/hw/player/payload.hpp"
#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "orca/hw/player/session.hpp"
#include "xdr.hpp"

namespace orca::hw::player {

// The members of each structure in the order of the line, for XdrWriter and XdrReader.

template <>
inline constexpr std::size_t kElementSize<Address> = 16;
template <>
inline constexpr std::size_t kElementSize<Pose3> = 48;
template <>
inline constexpr std::size_t kElementSize<Size3> = 24;

constexpr bool is_known(Interface) { return true; }  // others are passed on
constexpr bool is_known(Access access) { return access >= Access::open && access <= Access::refused; }
constexpr bool is_known(DataMode::Mode mode) {
  return mode == DataMode::Mode::push || mode == DataMode::Mode::pull;
}

template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Address> v) {
  xdr.all(v.host, v.robot, v.interface, v.index);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Pose3> v) {
  xdr.all(v.x, v.y, v.z, v.roll, v.pitch, v.yaw);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Size3> v) {
  xdr.all(v.width, v.length, v.height);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Planar> v) {
  xdr.all(v.x, v.y, v.yaw);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Geometry> v) {
  xdr.all(v.pose, v.size);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Switch> v) {
  xdr.all(v.on);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<DeviceList> v) {
  xdr.all(v.devices);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<DriverInfo> v) {
  xdr.all(v.device, v.driver);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Subscription> v) {
  xdr.all(v.device, v.access, v.driver);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<DataMode> v) {
  xdr.all(v.mode);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Capability> v) {
  xdr.all(v.type, v.subtype);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<Position2dState> v) {
  xdr.all(v.pose, v.velocity, v.stall);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<VelocityCommand> v) {
  xdr.all(v.velocity, v.motors_on);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<LaserScan> v) {
  xdr.all(v.min_angle, v.max_angle, v.resolution, v.max_range, v.ranges, v.intensities, v.id);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<LaserConfig> v) {
  xdr.all(v.min_angle, v.max_angle, v.resolution, v.max_range, v.range_resolution, v.with_intensity,
          v.frequency);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<SonarRanges> v) {
  xdr.all(v.ranges);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<SonarGeometry> v) {
  xdr.all(v.poses);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<RangerValues> v) {
  xdr.all(v.values);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<RangerGeometry> v) {
  xdr.all(v.pose, v.size, v.element_poses, v.element_sizes);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<RangerConfig> v) {
  xdr.all(v.min_angle, v.max_angle, v.angular_resolution, v.min_range, v.max_range, v.range_resolution,
          v.frequency);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<RangerStamped> v) {
  xdr.all(v.ranges, v.geometry, v.config);
}
template <class Xdr>
void fields(Xdr& xdr, typename Xdr::template Of<BumperState> v) {
  xdr.all(v.pressed);
}

// The mask says which of the values that follow are valid: 1 volts, 2 watts, 4 joules, 8 percent, 16 charging.
inline void fields(XdrWriter& xdr, const PowerState& v) {
  const std::uint32_t valid = (v.voltage ? 1U : 0U) | (v.power ? 2U : 0U) | (v.energy ? 4U : 0U) |
                              (v.charge ? 8U : 0U) | (v.charging ? 16U : 0U);
  xdr.all(valid, v.voltage.value_or(0.0F), v.charge.value_or(0.0F), v.energy.value_or(0.0F),
          v.power.value_or(0.0F), v.charging.value_or(0));
}
inline void fields(XdrReader& xdr, PowerState& v) {
  std::uint32_t valid = 0;
  PowerState read{0.0F, 0.0F, 0.0F, 0.0F, 0};
  xdr.all(valid, *read.voltage, *read.charge, *read.energy, *read.power, *read.charging);
  if ((valid & 1U) != 0) v.voltage = read.voltage;
  if ((valid & 2U) != 0) v.power = read.power;
  if ((valid & 4U) != 0) v.energy = read.energy;
  if ((valid & 8U) != 0) v.charge = read.charge;
  if ((valid & 16U) != 0) v.charging = read.charging;
}

}  // namespace orca::hw::player
