// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/retreat.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/geometry/arc.hpp"

namespace orca::nav {
namespace {

constexpr double kRetreatSpeed = 0.15;  // [m/s]
constexpr double kBehind = 0.2;         // [m] to the place of its trail that it backs to
constexpr double kTrailStep = 0.05;     // [m] or
constexpr double kTrailTurn = 0.1;      // [rad] between two places of the trail
constexpr std::size_t kTrail = 200;     // places in it
constexpr double kLook = 0.25;          // [m] of an arc that is looked at,
constexpr int kLookSteps = 5;           // in so many steps,
constexpr double kLeastWay =
    0.09;  // [m] of which so much must be free and known: it can stop within half of it
constexpr double kArcMargin = 0.01;     // [m] kept free around the outline,
constexpr double kTrailMargin = 0.005;  // [m] on its trail
constexpr double kBetween =
    0.03;  // [m] by which places of the trail may miss what was driven over between them
constexpr double kOutlineStep = 0.05;   // [m] between points of the outline
constexpr double kMotion = 0.02;        // [m] that count as motion
constexpr Duration kStandsFor = 800ms;  // without it

// Calls `visit` for points all around the outline of a robot at `pose`, until it returns false.
template <typename Visit>
bool walk_outline(const Footprint& footprint, const Pose2& pose, Visit visit) {
  const auto along = [&](Vec2 from, Vec2 to) {
    const int parts = std::max(1, static_cast<int>(std::ceil(norm(to - from) / kOutlineStep)));
    for (int i = 0; i < parts; ++i) {
      const Vec2 corner = from + (static_cast<double>(i) / parts) * (to - from);
      if (!visit(pose * shortened(corner, footprint.outer_radius()))) return false;
    }
    return true;
  };
  if (!footprint.is_circle()) {
    const double x = footprint.half_length;
    const double y = footprint.half_width;
    return along({x, -y}, {x, y}) && along({x, y}, {-x, y}) && along({-x, y}, {-x, -y}) &&
           along({-x, -y}, {x, -y});
  }
  constexpr int kParts = 24;
  for (int i = 0; i < kParts; ++i)
    if (!visit(pose * (footprint.radius * direction(2.0 * std::numbers::pi * i / kParts)))) return false;
  return true;
}

}  // namespace

void Retreat::note(const Pose2& pose) {
  if (retreated_)  // the obstacle is not behind it any more
    while (!trail_.empty() && seen_from(pose, trail_.back().position()).x > 0.0) trail_.pop_back();
  retreated_ = false;
  if (!trail_.empty() && norm(pose.position() - trail_.back().position()) < kTrailStep &&
      std::abs(wrapped(pose.yaw - trail_.back().yaw)) < kTrailTurn)
    return;
  if (trail_.size() == kTrail) trail_.erase(trail_.begin());
  trail_.push_back(pose);
}

void Retreat::begin() {
  if (!retreated_) left_ = trail_.size();
  retreated_ = true;
  has_turned_back_ = has_moved_ = false;
  moved_at_.reset();
}

Steer Retreat::step(TimePoint now, const Scene& scene, const Seen& seen) {
  const View view{scene, seen};
  Steer steer = stays(now, scene.pose.position()) ? Steer{.blocked = true} : way_out(view);
  if (!steer.blocked || has_moved_ || has_turned_back_) return steer;
  has_turned_back_ = true;
  direction_ = -direction_;
  return way_out(view);
}

// Returns whether the robot has not moved for some time although it should have: it has met something that nobody sees.
bool Retreat::stays(TimePoint now, Vec2 place) {
  if (!moved_at_ || norm(place - stood_at_) > kMotion) {
    has_moved_ = moved_at_.has_value();
    moved_at_ = now;
    stood_at_ = place;
  }
  if (now - *moved_at_ <= kStandsFor) return false;
  moved_at_ = now;
  return true;
}

Steer Retreat::way_out(const View& view) {
  const auto trail = direction_ < 0.0 ? curvature_of_trail(view.scene.pose) : std::nullopt;
  if (trail && free_way(view, *trail, kTrailMargin) >= kLeastWay) return drive(*trail);
  Steer best{.blocked = true};
  double longest = kLeastWay;
  for (const double curvature : {0.0, 1.0, -1.0, 2.0, -2.0}) {
    const double way = free_way(view, curvature, kArcMargin);
    if (way <= longest) continue;
    longest = way;
    best = drive(curvature);
  }
  return best;
}

Steer Retreat::drive(double curvature) const {
  return {direction_ * kRetreatSpeed, direction_ * kRetreatSpeed * curvature, false, false};
}

// Returns the curvature of the arc back to a place of the trail, if there is one behind.
std::optional<double> Retreat::curvature_of_trail(const Pose2& pose) {
  left_ = std::min(left_, trail_.size());
  while (left_ > 0 && norm(trail_[left_ - 1].position() - pose.position()) < kBehind) --left_;
  if (left_ == 0) return std::nullopt;
  const Vec2 back = seen_from(pose, trail_[left_ - 1].position());
  if (back.x >= -std::abs(back.y)) return std::nullopt;
  return arc_to(back).curvature;
}

// Returns how much of an arc [m] is free and known.
double Retreat::free_way(const View& view, double curvature, double margin) const {
  const auto travel = [&](int step) {
    const double way = direction_ * kLook * step / kLookSteps;
    return Travel2{way, 0.0, way * curvature};
  };
  const Room room =
      room_along(footprint_, view.scene.pose, travel(kLookSteps), kLookSteps, view.scene.points, margin);
  const int free = static_cast<int>(std::lround(room.share * kLookSteps));
  int known = 0;
  while (known < free && is_known(view, along_arc(view.scene.pose, travel(known + 1)))) ++known;
  return kLook * known / kLookSteps;
}

// Returns whether the robot would cover only floor there that it has driven over or seen.
bool Retreat::is_known(const View& view, const Pose2& place) const {
  return walk_outline(footprint_, place, [&](Vec2 point) {
    const auto covered = [&](const Pose2& pose) { return has_covered(pose, point); };
    return covered(view.scene.pose) || std::ranges::any_of(trail_, covered) || view.seen(point);
  });
}

bool Retreat::has_covered(const Pose2& pose, Vec2 point) const {
  return clearance(footprint_, seen_from(pose, point)) <= kBetween;
}

}  // namespace orca::nav
