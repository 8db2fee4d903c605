// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "motion.hpp"
#include "orca/avoidance/laser_avoider.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/geometry/pose2.hpp"

namespace {

double bearing(orca::Vec2 place) { return orca::portable::atan2(place.y, place.x); }

std::vector<orca::Vec2> seen_from(const orca::Pose2& X_RB, std::span<const orca::Vec2> echoes) {
  std::vector<orca::Vec2> seen;
  for (const orca::Vec2 echo : echoes) seen.push_back(orca::seen_from(X_RB, echo));
  return seen;
}

/// A behaviour that drives the robot to its goal past what its laser sees, by ND+ (Minguez, Osuna and Montano, 2004). See
/// README.md.
class NdPlus final : public orca::avoid::LaserAvoider {
 public:
  explicit NdPlus(orca::ComponentHost& host) : LaserAvoider(host, {.hidden = true, .time = kMemoryTime}) {}

 private:
  orca::Status start() override {
    turning_to_ = 0.0;
    went_.reset();
    return LaserAvoider::start();
  }

  // With a goal it drives alone, as in the paper: all it says has full weight. Within reach of the goal it leaves coming to
  // rest to whoever sent the goal, and speaks only if the robot could not stop in time.
  orca::avoid::Advice advice(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
                             const orca::avoid::Limits& limits) override {
    const orca::nd::Settings settings = this->settings(limits);
    const bool arrives = situation.goal && situation.goal_distance < situation.goal_reach;
    if (arrives || !situation.goal) {
      const orca::nd::Course now{std::max(0.0, situation.speed), situation.turn_rate};
      const bool free = arrives || way_ahead(memory.echoes(), situation, limits) >= limits.safe_distance;
      if (free && is_safe(now, memory.echoes(), settings)) return {};
    }
    orca::nd::Course course = steer(memory.echoes(), situation, settings);
    if (course.speed < kStanding && std::abs(course.turn_rate) < kStanding)
      course = turn_on_the_spot(memory.echoes(), situation, settings);
    else
      turning_to_ = 0.0;
    return {true, course.turn_rate, course.speed, 1.0, course.turn_rate};
  }

  // Returns the course of ND+ as far as the body can follow; standing where no region has room for it.
  [[nodiscard]] orca::nd::Course steer(std::span<const orca::Vec2> echoes,
                                       const orca::avoid::Situation& situation,
                                       const orca::nd::Settings& settings) {
    const double radius = orca::nd::half_way(settings.body) + settings.margin;
    const auto area = free_walking_area(echoes, goal(situation), radius);
    if (!area) return {};
    went_ = area->holds_goal() ? std::nullopt : std::optional(situation.heading + bearing(area->place));
    const orca::Pose2 then = when_it_follows(situation);
    const orca::nd::FreeWalkingArea ahead = seen_from(then, *area);
    const orca::nd::Dangers near = dangers(seen_from(then, echoes), bearing(ahead.place), settings);
    orca::nd::Course wanted = course(motion_direction(near, ahead, radius, settings), near.share(), settings);
    if (situation.goal && !situation.passes_goal)
      wanted.speed = std::min(wanted.speed, speed_to_stop(situation.goal_distance, settings));
    return made_safe(wanted, near.share(), situation.turn_rate, echoes, settings);
  }

  // Towards the goal, and on to the same side as long as there is room.
  [[nodiscard]] orca::nd::Course turn_on_the_spot(std::span<const orca::Vec2> echoes,
                                                  const orca::avoid::Situation& situation,
                                                  const orca::nd::Settings& settings) {
    if (turning_to_ == 0.0) turning_to_ = situation.goal.value_or(0.0) < 0.0 ? -1.0 : 1.0;
    for (const double side : {turning_to_, -turning_to_}) {
      const orca::nd::Course turn =
          made_safe({0.0, side * settings.max_turn_rate}, 0.0, 0.0, echoes, settings);
      if (std::abs(turn.turn_rate) < kStanding) continue;
      turning_to_ = side;
      return turn;
    }
    return {};
  }

  // The pose at which the robot can follow what is said now. If it were steered by what it sees from where it is, it would sway
  // between two walls, ever wider.
  [[nodiscard]] orca::Pose2 when_it_follows(const orca::avoid::Situation& situation) const {
    return orca::moved({situation.speed, 0.0, situation.turn_rate}, reaction_time());
  }

  [[nodiscard]] orca::nd::Goal goal(const orca::avoid::Situation& situation) const {
    orca::nd::Goal goal{0.0, kStraightOn};
    if (situation.goal)
      goal = {*situation.goal, std::max(0.0, situation.goal_distance - situation.goal_reach)};
    if (went_) goal.last = orca::wrapped(*went_ - situation.heading);
    return goal;
  }

  [[nodiscard]] orca::nd::Settings settings(const orca::avoid::Limits& limits) const {
    return {.body = outline(),
            .security_distance = *security_distance_,
            .wide = *wide_region_,
            .max_speed = limits.max_speed,
            .max_turn_rate = *max_turn_rate_,
            .least_share = *least_share_,
            .margin = std::min(limits.margin, *least_margin_),
            .reaction = reaction_time(),
            .brakes = {*deceleration_, *turn_deceleration_}};
  }

  // [s] A robot that stands in a narrow place must not forget what its laser cannot see there before it turns.
  static constexpr double kMemoryTime = 10.0;
  static constexpr double kStraightOn = 100.0;  // [m]
  static constexpr double kStanding = 0.02;     // [m/s], [rad/s] less than this is no motion.

  orca::Param<double> security_distance_{
      *this,
      "security_distance",
      0.2,
      {.unit = "m",
       .min = 0.01,
       .text = "Distance from the body within which an obstacle is dangerous (D_s)."}};
  orca::Param<double> wide_region_{
      *this,
      "wide_region",
      0.5 * std::numbers::pi,
      {.unit = "rad",
       .min = 0.0,
       .text = "Width of a region beyond which the robot passes its edge instead of taking its middle."}};
  orca::Param<double> max_turn_rate_{
      *this,
      "max_turn_rate",
      1.5,
      {.unit = "rad/s",
       .min = 0.01,
       .text = "Turn rate for a direction at a right angle; in proportion for others."}};
  orca::Param<double> least_share_{
      *this,
      "least_share",
      0.2,
      {.min = 0.0, .max = 1.0, .text = "Share of the speed that is left however near an obstacle is."}};
  orca::Param<double> least_margin_{
      *this,
      "least_margin",
      0.05,
      {.unit = "m", .min = 0.0, .text = "Free space to keep where there is no room for the margin."}};
  orca::Param<double> deceleration_{
      *this,
      "deceleration",
      0.5,
      {.unit = "m/s2", .min = 0.01, .text = "Deceleration that the base reaches."}};

  orca::Param<double> turn_deceleration_{
      *this, "turn_deceleration", 2.0, {.unit = "rad/s2", .min = 0.01, .text = "The same of its turn rate."}};

  std::optional<double>
      went_;  // [rad] direction of the edge that it goes past, in axes that do not turn; if any.
  double turning_to_ = 0.0;  // The side to which it turns as it finds no way, +1 or -1; 0: it finds one.
};

}  // namespace

ORCA_COMPONENT(NdPlus, "orca.NdPlus")
