// SPDX-License-Identifier: LGPL-3.0-or-later
#include "touch_guard.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace orca::sim {
namespace {

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
  for (const OdometryReading& reading : inbox.odometry)
    if (stall_.look(reading)) motion_.obstruct("its motors are stalled", hw::Hindrance::stall);
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

}  // namespace orca::sim
