// SPDX-License-Identifier: LGPL-3.0-or-later
#include "pursuit.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::follow {
namespace {

constexpr double kCrumb = 0.1;       // [m] between two places of the trail
constexpr double kPassed = 0.35;     // [m] A place that is so near is passed.
constexpr double kLookAhead = 0.6;   // [m] along the trail
constexpr double kTakes = 3.0;       // [m] to whom it begins to follow
constexpr double kBeforeIt = 1.05;   // [rad] to either side
constexpr double kSame = 1.5;        // [m] from where he was seen last, where a new one is the same
constexpr double kGone = 0.5;        // [s] after which somebody unseen is out of sight
constexpr double kGain = 0.8;        // [1/s] of speed per metre too far away
constexpr double kNearEnough = 0.3;  // [m] from where somebody was seen last, who walked on
constexpr double kGoesOn = 3.0;      // [m] for which somebody out of sight is supposed to go straight on
constexpr double kWalks = 0.25;      // [m/s]
constexpr double kTurnFirst = 0.9;   // [rad]
constexpr double kTurnGain = 1.5;    // [1/s]
constexpr double kTurnRate = 1.0;    // [rad/s]
constexpr double kLookRate = 0.7;    // [rad/s]

double bearing_of(Vec2 place, const Pose2& robot) {
  return wrapped(portable::atan2(place.y - robot.y, place.x - robot.x) - robot.yaw);
}

double limited(double rate) { return std::clamp(rate, -kTurnRate, kTurnRate); }

}  // namespace

Step Pursuit::step(const Pose2& robot, std::span<const Person> people, double time, const Manner& manner) {
  if (const Person* const person = find(robot, people, time, manner)) {
    if (went_on_) trail_.pop_back();
    // The way of somebody who comes into sight again near by does not matter: the robot sees him from where it is.
    const bool is_near = norm(person->place - robot.position()) < kTakes;
    if (!target_ || (went_on_ && is_near)) trail_.clear();
    went_on_ = false;
    target_ = Target{*person, time};
    extend(person->place);
  }
  if (!target_) return {};
  shorten(robot);
  const double away = time - target_->seen_at;
  if (away > manner.search) {
    target_.reset();
    return {.kind = Step::Kind::lost};
  }
  const double pace = norm(target_->person.velocity);
  if (away <= kGone) {
    const double wanted = pace + kGain * (way_left(robot) - manner.distance);
    return drive(robot, std::clamp(wanted, 0.0, manner.max_speed));
  }
  if (!went_on_) go_on();
  // Who walked is somewhere beyond that place; who stood may stand there still.
  const double room = pace > kWalks ? kNearEnough : manner.distance;
  if (way_left(robot) <= room) return look_around(robot);
  Step step = drive(robot, std::min(manner.max_speed, std::max(0.2, kGain * (way_left(robot) - room))));
  step.kind = Step::Kind::searches;
  return step;
}

// Returns whom it follows, if he was seen just now: by his number, by where he was, or whoever walks before it.
const Person* Pursuit::find(const Pose2& robot, std::span<const Person> people, double time,
                            const Manner& manner) const {
  const auto nearest = [&](Vec2 to, double limit, auto&& counts) {
    const Person* best = nullptr;
    for (const Person& person : people) {
      const double distance = norm(person.place - to);
      if (person.unseen > kGone || distance > limit || !counts(person)) continue;
      if (!best || distance < norm(best->place - to)) best = &person;
    }
    return best;
  };
  if (!target_)
    return nearest(robot.position(), kTakes, [&](const Person& person) {
      return std::fabs(bearing_of(person.place, robot)) <= kBeforeIt;
    });
  const auto same =
      std::ranges::find(people, target_->person.number, [](const Person& person) { return person.number; });
  if (same != people.end()) return same->unseen <= kGone ? &*same : nullptr;
  const double walked = std::min(time - target_->seen_at, manner.search) * norm(target_->person.velocity);
  return nearest(target_->person.place, kSame + walked, [](const Person&) { return true; });
}

void Pursuit::extend(Vec2 place) {
  if (trail_.empty() || norm(place - trail_.back()) >= kCrumb) trail_.push_back(place);
}

// Supposes that who walked out of sight goes straight on. From behind, a laser does not distinguish who walks from what stands, until he turns aside.
void Pursuit::go_on() {
  const double pace = norm(target_->person.velocity);
  const double way = pace > kWalks ? kGoesOn : 0.0;
  trail_.push_back(trail_.back() + (pace > kWalks ? way / pace : 0.0) * target_->person.velocity);
  went_on_ = true;
}

void Pursuit::shorten(const Pose2& robot) {
  std::size_t passed = 0;
  for (std::size_t i = 0; i + 1 < trail_.size(); ++i)
    if (norm(trail_[i] - robot.position()) < kPassed) passed = i + 1;
  trail_.erase(trail_.begin(), trail_.begin() + static_cast<std::ptrdiff_t>(passed));
}

double Pursuit::way_left(const Pose2& robot) const {
  double way = 0.0;
  Vec2 from = robot.position();
  for (const Vec2 place : trail_) {
    way += norm(place - from);
    from = place;
  }
  return way;
}

Step Pursuit::drive(const Pose2& robot, double speed) const {
  Vec2 aim = trail_.back();
  double way = 0.0;
  Vec2 from = robot.position();
  for (const Vec2 place : trail_) {
    way += norm(place - from);
    from = place;
    if (way >= kLookAhead) {
      aim = place;
      break;
    }
  }
  const double bearing = bearing_of(aim, robot);
  const double rate = limited(kTurnGain * bearing);
  if (std::fabs(bearing) > kTurnFirst) return {Step::Kind::follows, 0.0, rate, aim};
  return {Step::Kind::follows, speed * portable::cos(bearing), rate, aim};
}

// It turns towards where he went, and on.
Step Pursuit::look_around(const Pose2& robot) const {
  const Vec2 went = target_->person.velocity;
  const double bearing = wrapped(portable::atan2(went.y, went.x) - robot.yaw);
  return {Step::Kind::searches, 0.0, bearing < 0.0 ? -kLookRate : kLookRate};
}

}  // namespace orca::follow
