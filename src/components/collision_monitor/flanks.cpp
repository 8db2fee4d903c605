// SPDX-License-Identifier: LGPL-3.0-or-later
#include "flanks.hpp"

#include <algorithm>

namespace orca::gate {
namespace {

constexpr double kErrorOfPlace = 0.1;     // [m]
constexpr double kErrorOfVelocity = 0.3;  // [m/s]
constexpr double kNear = 1.5;             // [m] from the robot
constexpr double kBody = 0.4;             // [m] of a person from his nearest leg

}  // namespace

Flanks::Sonar& Flanks::sonar(const std::string& ring, std::size_t number) {
  const auto known = std::ranges::find_if(
      sonars_, [&](const Sonar& sonar) { return sonar.number == number && sonar.ring == ring; });
  return known != sonars_.end() ? *known : sonars_.emplace_back(Sonar{ring, number, {}, -1.0, 0, {}});
}

void Flanks::hear(const std::string& ring, const Firing& firing, bool explained) {
  Sonar& sonar = this->sonar(ring, firing.sonar);
  if (firing.range >= std::min(kRange, firing.farthest)) {
    sonar.heard = -1.0;
    sonar.nearer = 0;
    return;
  }
  const Vec2 axis = direction(firing.X_OS.yaw);
  const double elapsed = firing.time - sonar.heard;
  if (!explained && sonar.heard >= 0.0 && elapsed > 0.0 && elapsed < kFresh) {
    const double pace = (norm(sonar.place - firing.X_OS.position()) - firing.range) / elapsed;
    sonar.nearer = pace > kSlowest && pace < kFastest ? sonar.nearer + 1 : 0;
    sonar.velocity = -pace * axis;
  } else {
    sonar.nearer = 0;
  }
  sonar.heard = firing.time;
  sonar.place = firing.X_OS.position() + firing.range * axis;
}

std::vector<Passer> Flanks::comers(double now, const Pose2& X_OR) const {
  std::vector<Passer> comers;
  for (const Sonar& sonar : sonars_) {
    if (sonar.nearer < kTimes || now - sonar.heard > kFresh) continue;
    const Vec2 place = sonar.place + (now - sonar.heard) * sonar.velocity;
    if (norm(place - X_OR.position()) > kNear) continue;
    comers.push_back({.place = seen_from(X_OR, place),
                      .velocity = rotated(sonar.velocity, -X_OR.yaw),
                      .radius = kBody,
                      .place_error = kErrorOfPlace,
                      .velocity_error = kErrorOfVelocity});
  }
  return comers;
}

}  // namespace orca::gate
