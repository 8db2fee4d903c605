// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

/// Units and frames of the robot's client library beside Orca's. The library counts in mm and mrad, and its y axis looks ahead
/// and its x axis to the right. Orca's x axis looks ahead and its y axis to the left.
namespace orca::hw::xr4000 {

inline constexpr double kRadius = 0.3;  ///< [m] on which the sonars sit.
inline constexpr std::size_t kSets =
    6;  ///< Sets of sonars, of infrared sensors and of bumpers; two at each door.
inline constexpr std::size_t kPerSet = 8;                ///< Sonars, or infrared sensors, of a set.
inline constexpr std::size_t kSonars = kSets * kPerSet;  ///< The sensor i of set s has the number 8 s + i.

inline constexpr std::int32_t kMaxSpeed = 1500;             ///< [mm/s]
inline constexpr std::int32_t kMaxTurnRate = 500;           ///< [mrad/s]
inline constexpr std::int32_t kMaxAcceleration = 1500;      ///< [mm/s^2]
inline constexpr std::int32_t kMaxTurnAcceleration = 5000;  ///< [mrad/s^2]

/// A value for each axis, in the library's units.
struct Axes {
  std::int32_t x = 0;         ///< [mm, mm/s, mm/s^2] to the right
  std::int32_t y = 0;         ///< [mm, mm/s, mm/s^2] ahead
  std::int32_t rotation = 0;  ///< [mrad, mrad/s, mrad/s^2] positive to the left
  friend bool operator==(const Axes&, const Axes&) = default;
};

/// Returns the speeds of the axes for a velocity, at most kMaxSpeed and kMaxTurnRate each. What is not finite counts as 0.
[[nodiscard]] Axes speeds_of(const Twist2& velocity);
/// Returns the velocity of the robot frame.
[[nodiscard]] Twist2 velocity_of(const Axes& speeds);
/// Returns the accelerations of the axes, from 1 to kMaxAcceleration and kMaxTurnAcceleration.
/// @param translation  [m/s^2]  @param turn  [rad/s^2]
[[nodiscard]] Axes accelerations_of(double translation, double turn);
/// Returns the pose that the integrator counts; its yaw is in (-pi, pi].
[[nodiscard]] Pose2 pose_of(const Axes& integrator);

/// Returns where a sonar sits in the robot frame [m]; its x axis is the axis of the cone. The infrared sensors sit likewise.
/// @param number  below kSonars.
/// @source  CARMEN, src/base/xr4000_base: positions of the sonars.
[[nodiscard]] Pose2 sonar_place(std::size_t number);

/// Returns the door of a set: 0 ahead, 1 behind to the left, 2 behind to the right.
[[nodiscard]] constexpr std::size_t door_of(std::size_t set) { return set / 2; }
/// Returns the direction from the robot's middle to that of a door [rad], positive to the left.
[[nodiscard]] double door_direction(std::size_t door);

/// The pose of the robot by its integrator. It begins at 0, and after forget() it goes on from where it was.
///
/// Thread contract: not synchronised.
class IntegratorOdometry {
 public:
  /// Takes what the integrator says. The first one after forget() moves nothing.
  void add(const Axes& integrator);
  /// Makes the next value a new reference: after the connection was opened again, or set_integrator().
  void forget() { origin_.reset(); }
  /// Returns the pose in the frame of the odometry.
  [[nodiscard]] const Pose2& pose() const { return pose_; }

 private:
  std::optional<Pose2> origin_;  // of the integrator's frame in that of the odometry
  Pose2 pose_;
};

}  // namespace orca::hw::xr4000
