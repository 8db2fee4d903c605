// SPDX-License-Identifier: LGPL-3.0-or-later
#include "touch_guard.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"

namespace orca::sim {
namespace {

constexpr Duration kStallTime = std::chrono::milliseconds(500);  // from rest, lag and inertia take less
constexpr double kStallShare = 0.1;                              // [1] of the velocity that was asked for

// Returns where on the body a direction [rad] points.
std::string side_name(double angle) {
  constexpr std::array kNames{"front", "front left", "left",  "rear left",
                              "rear",  "rear right", "right", "front right"};
  const auto octant = std::lround(angle / (std::numbers::pi / 4.0));
  return kNames[static_cast<std::size_t>((octant + 8) % 8)];
}

}  // namespace

void TouchGuard::look(const SharedWorld::Inbox& inbox) {
  // A base with bumpers feels what they feel; of one without any, every touch counts.
  if (robot_.bumpers.empty())
    for (const auto& contact : inbox.contacts) motion_.obstruct("it touched " + contact.event.other);
  for (const auto& [ring, reading] : inbox.bumper) motion_.press(pressed(ring, reading));
  for (const OdometryReading& reading : inbox.odometry) {
    if (!turned_at_ || !is_stalled(reading)) turned_at_ = reading.stamp;
    if (reading.stamp - *turned_at_ < kStallTime) continue;
    turned_at_.reset();
    motion_.obstruct("its motors are stalled");
  }
}

void TouchGuard::driven(const Twist2& velocity, TimePoint now) {
  if (velocity == Twist2{} || driven_ == Twist2{}) turned_at_ = now;
  driven_ = velocity;
}

std::vector<hw::Obstruction::Pressed> TouchGuard::pressed(std::size_t ring,
                                                          const BumperReading& reading) const {
  std::vector<hw::Obstruction::Pressed> switches;
  for (std::size_t k = 0; k < reading.pressed.size(); ++k) {
    if (!reading.pressed[k]) continue;
    const double angle = (reading.X_RB * robot_.bumpers[ring].segment(k)).yaw;
    switches.push_back({direction(angle), side_name(angle)});
  }
  return switches;
}

bool TouchGuard::is_stalled(const OdometryReading& reading) const {
  const double wanted = portable::hypot(driven_.forward, driven_.left);
  const double driving = portable::hypot(reading.velocity.forward, reading.velocity.left);
  if (wanted > 0.0) return driving < kStallShare * wanted;
  return driven_.turn_rate != 0.0 &&
         std::abs(reading.velocity.turn_rate) < kStallShare * std::abs(driven_.turn_rate);
}

}  // namespace orca::sim
