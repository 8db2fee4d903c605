// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mates.hpp"

#include <algorithm>
#include <cmath>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"

namespace orca::team {
namespace {

constexpr std::uint32_t kFirstNumber = 1'000'001;  // Trackers count from 1.
constexpr double kChange = 0.1;                    // [m/s] by which a robot may drive otherwise than it says
constexpr Duration kFarAway = std::chrono::hours(1);  // No pose is that old, and none that far ahead.

}  // namespace

void Mates::hear(const idl::Teammate& mate, TimePoint now) {
  const TimePoint stamp = to_time_point(mate.pose().stamp());
  if (stamp < now - kFarAway || stamp > now + kFarAway || is_anywhere(mate.pose().covariance())) return;
  if (!mates_.contains(mate.origin())) {
    if (mates_.size() >= kMost) return;
    mates_[mate.origin()].number = kFirstNumber + last_number_++;
  }
  Mate& known = mates_.at(mate.origin());
  const Pose2 X_MB = plane_pose(mate.pose());
  known.name = mate.name();
  known.stamp = stamp;
  known.heard = now;
  known.map = mate.map_name();
  known.place = X_MB.position();
  known.velocity = rotated(Vec2{mate.translational_velocity(), mate.sideways_velocity()}, X_MB.yaw);
  known.radius = mate.radius();
  known.place_error = position_deviation(mate.pose().covariance());
  known.hears = mate.hears();
}

void Mates::forget(TimePoint now, Duration lost_after) {
  std::erase_if(mates_, [&](const auto& one) { return now - one.second.heard > lost_after; });
}

std::vector<std::string> Mates::names() const {
  std::vector<std::string> all;
  for (const auto& [origin, mate] : mates_) all.push_back(mate.name);
  return all;
}

bool Mates::lets_pass(const Mate& mate, const Here& here) {
  return here.name < mate.name && std::ranges::find(mate.hears, here.name) != mate.hears.end();
}

void Mates::add(const Here& here, TimePoint at, idl::MovingThings& moving) const {
  for (const auto& [origin, mate] : mates_) {
    if (mate.map != here.map || lets_pass(mate, here)) continue;
    const double age = to_seconds(at - mate.stamp);
    const Vec2 velocity = rotated(mate.velocity, here.X_OM.yaw);
    const Vec2 place = here.X_OM * mate.place + age * velocity;
    idl::MovingThing& thing = moving.things().emplace_back();
    thing.number(mate.number);
    thing.x(place.x);
    thing.y(place.y);
    thing.velocity_x(velocity.x);
    thing.velocity_y(velocity.y);
    thing.radius(mate.radius);
    thing.place_error(norm(Vec2{mate.place_error, here.place_error}) + std::abs(age) * kChange);
    thing.velocity_error(kChange);
    thing.unseen(std::max(age, 0.0));
  }
}

}  // namespace orca::team
