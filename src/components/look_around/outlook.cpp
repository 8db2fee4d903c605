// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outlook.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"

namespace orca::look {
namespace {

constexpr double kRound = 2.0 * std::numbers::pi;
constexpr double kStep = kRound / Panorama::kDirections;
constexpr double kHalfRound = 3.3;  // [rad] A laser that sees a half circle has then seen all around.
constexpr double kUrgency =
    0.5;  // half way between a wish that does not count and one that nobody may overrule
constexpr double kThick = 0.2;        // [m] of what is between two echoes
constexpr double kAround = 1.5;       // [m] from a place to what is looked for there
constexpr int kLooks = 16;            // around a place
constexpr int kLeastNews = 2;         // of them
constexpr double kShortest = 0.5;     // [m] of a leg
constexpr double kBetween = 0.5;      // [m] between two places to which it may go
constexpr double kBeforeWall = 0.4;   // [m] A leg ends there, so that the robot can turn.
constexpr double kThere = 0.15;       // [m]
constexpr double kPricePerWay = 0.7;  // [1/m] of the news
constexpr double kFacing = 0.5;       // [rad] off its way it turns on the spot
constexpr double kNearer = 0.05;      // [m]
constexpr double kPatience = 7.0;     // [s] without coming nearer, the turn at first included
constexpr double kLeastTurn = 0.1;    // [rad] A turn for which there is less room does not begin.

avoid::Advice turning(double rate) { return {true, rate, 0.0, kUrgency, rate}; }

double bearing(Vec2 way) { return portable::atan2(way.y, way.x); }

std::size_t sector_of(double angle) {
  const auto sector = static_cast<long>(std::lround(angle / kStep));
  const auto all = static_cast<long>(Panorama::kDirections);
  return static_cast<std::size_t>((sector % all + all) % all);
}

// Returns the distance of a point from the line between two others.
double distance_to(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 way = to - from;
  const double part = std::clamp(dot(point - from, way) / dot(way, way), 0.0, 1.0);
  return norm(from + part * way - point);
}

bool is_hidden(Vec2 place, Vec2 from, std::span<const Panorama> seen) {
  return std::ranges::any_of(seen, [&](const Panorama& one) {
    return std::ranges::any_of(one.echoes,
                               [&](Vec2 echo) { return distance_to(echo, from, place) < kThick; });
  });
}

// Returns the side to which there is room to turn, the same as before if possible; 0 if there is none.
double side_for(double before, const avoid::TurnRoom& room) {
  const auto has_room = [&](double side) { return room.allows(side * kLeastTurn); };
  if (before != 0.0 && has_room(before)) return before;
  if (has_room(1.0) && room.left >= room.right) return 1.0;
  if (has_room(-1.0)) return -1.0;
  return has_room(1.0) ? 1.0 : 0.0;
}

}  // namespace

Panorama::Panorama(const Pose2& X_OR, std::span<const Vec2> around) : from(X_OR.position()) {
  ranges.fill(kFar);
  for (const Vec2 echo : around) {
    const double range = norm(echo);
    if (range >= kFar) continue;
    echoes.push_back(X_OR * echo);
    double& nearest = ranges[sector_of(X_OR.yaw + bearing(echo))];
    nearest = std::min(nearest, range);
  }
}

bool Panorama::shows(Vec2 place) const {
  const Vec2 way = place - from;
  return norm(way) < ranges[sector_of(bearing(way))];
}

int news_at(Vec2 place, std::span<const Panorama> seen) {
  int news = 0;
  for (int i = 0; i < kLooks; ++i) {
    const Vec2 there = place + kAround * direction(i * kRound / kLooks);
    const bool is_known = std::ranges::any_of(seen, [&](const Panorama& one) { return one.shows(there); });
    if (!is_known && !is_hidden(there, place, seen)) ++news;
  }
  return news;
}

void Outlook::reset() {
  turn_ = {};
  leg_.reset();
  seen_.clear();
}

std::optional<avoid::Advice> Outlook::step(const Moment& moment, const Limits& limits) {
  return leg_ ? drive(moment, limits) : turn(moment, limits);
}

std::optional<avoid::Advice> Outlook::turn(const Moment& moment, const Limits& limits) {
  const double yaw = moment.X_OR.yaw;
  if (turn_.side != 0.0) turn_.turned += std::fabs(wrapped(yaw - turn_.last_yaw));
  turn_.last_yaw = yaw;
  const double side = side_for(turn_.side, turn_room(moment.echoes, moment.situation, limits.body));
  const bool turns_back = turn_.side != 0.0 && side != turn_.side;
  if (turn_.turned < kHalfRound && side != 0.0 && !turns_back) {
    turn_.side = side;
    return turning(side * limits.turn_rate);
  }
  seen_.emplace_back(moment.X_OR, moment.echoes);
  leg_ = next_leg(moment, limits);
  turn_ = {};
  if (leg_) return drive(moment, limits);
  seen_.clear();  // all has been seen, so it goes round again
  return side == 0.0 ? std::nullopt : std::optional(turning(side * limits.turn_rate));
}

// To the place from which most is seen that was not seen yet, or is near.
std::optional<Outlook::Leg> Outlook::next_leg(const Moment& moment, const Limits& limits) const {
  avoid::Limits view = limits.body;
  view.safe_distance = Panorama::kFar;
  view.squeezes = view.body.has_value();
  std::optional<Leg> best;
  double best_score = 0.0;
  for (std::size_t i = 0; i < Panorama::kDirections; ++i) {
    const double angle = static_cast<double>(i) * kStep;
    const double way = free_way(moment.echoes, wrapped(angle), view) - kBeforeWall;
    for (double length = kShortest; length <= way; length += kBetween) {
      const Vec2 to = moment.X_OR.position() + length * direction(moment.X_OR.yaw + angle);
      const int news = news_at(to, seen_);
      const double score = news - kPricePerWay * length;
      if (news < kLeastNews || (best && score <= best_score)) continue;
      best_score = score;
      best = Leg{to, length, moment.time};
    }
  }
  return best;
}

std::optional<avoid::Advice> Outlook::drive(const Moment& moment, const Limits& limits) {
  const Vec2 way = leg_->to - moment.X_OR.position();
  const double left = norm(way);
  const double off = wrapped(bearing(way) - moment.X_OR.yaw);
  const bool faces = std::fabs(off) <= kFacing;
  if (left < leg_->nearest - kNearer) {
    leg_->nearest = left;
    leg_->got_on_at = moment.time;
  }
  if (left < kThere || moment.time - leg_->got_on_at > kPatience) {
    leg_.reset();
    return turn(moment, limits);
  }
  const double side = off < 0.0 ? -1.0 : 1.0;
  if (!faces && turn_room(moment.echoes, moment.situation, limits.body).allows(side * kLeastTurn))
    return turning(side * limits.turn_rate);
  avoid::Situation situation = moment.situation;
  situation.goal = off;
  situation.goal_distance = left;
  const avoid::Advice around = avoid::avoid(moment.echoes, situation, limits.body);
  if (around.needed)
    return avoid::Advice{true, around.direction, around.speed, std::max(kUrgency, around.urgency)};
  return avoid::Advice{true, off, limits.body.max_speed, kUrgency};
}

}  // namespace orca::look
