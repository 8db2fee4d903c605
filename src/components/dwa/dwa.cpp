// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>

#include "orca/avoidance/laser_avoider.hpp"
#include "window.hpp"

namespace {

/// A behaviour that drives the robot to its goal past what its laser sees, by the Dynamic Window Approach (Fox, Burgard and
/// Thrun, 1997). See README.md.
class Dwa final : public orca::avoid::LaserAvoider {
 public:
  explicit Dwa(orca::ComponentHost& host) : LaserAvoider(host, {.hidden = true}) {}

 private:
  orca::Status start() override {
    state_ = {};
    return LaserAvoider::start();
  }

  // With a goal it drives alone, as in the paper: all it says has full weight. Within reach of the goal it leaves coming to
  // rest to whoever sent the goal, and speaks only if the robot could not stop in time.
  orca::avoid::Advice advice(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
                             const orca::avoid::Limits& limits) override {
    const orca::Twist2 now{std::max(0.0, situation.speed), 0.0, situation.turn_rate};
    const orca::dwa::Settings settings = this->settings(limits);
    const bool arrives = situation.goal && situation.goal_distance < situation.goal_reach;
    if (arrives || !situation.goal) {
      const double way = way_ahead(memory.echoes(), situation, limits);
      const bool free = arrives || way >= limits.safe_distance;
      const double time = room_on(now, memory.echoes(), settings).time;
      if (free && can_stop(now, time, settings.robot.brakes())) return {};
    }
    return said(steer(now, scene(memory, situation), *leave_way_, settings, state_));
  }

  [[nodiscard]] static orca::avoid::Advice said(const orca::Twist2& wanted) {
    return {true, wanted.turn_rate, wanted.forward, 1.0, wanted.turn_rate};
  }

  [[nodiscard]] static orca::dwa::Scene scene(const orca::avoid::EchoMemory& memory,
                                              const orca::avoid::Situation& situation) {
    if (!situation.goal) return {memory.echoes(), {kStraightOn, 0.0}, std::nullopt};
    const orca::Vec2 goal = situation.goal_distance * orca::direction(*situation.goal);
    return {memory.echoes(), goal,
            situation.passes_goal ? std::nullopt : std::optional(situation.goal_distance)};
  }

  [[nodiscard]] orca::dwa::Settings settings(const orca::avoid::Limits& limits) const {
    return {.robot = {limits.max_speed, *max_turn_rate_, *acceleration_, *turn_acceleration_},
            .weights = {*heading_weight_, *distance_weight_, *speed_weight_},
            .interval = *interval_,
            .reaction = reaction_time(),
            .far = limits.safe_distance,
            .body = outline(),
            .margin = limits.margin,
            .least_margin = *least_margin_};
  }

  static constexpr double kStraightOn = 100.0;  // [m]

  orca::Param<double> interval_{
      *this,
      "interval",
      0.25,
      {.unit = "s", .min = 0.01, .text = "Time in which a velocity must be reachable to be considered (t)."}};
  orca::Param<double> acceleration_{
      *this,
      "acceleration",
      0.5,
      {.unit = "m/s2", .min = 0.01, .text = "Acceleration and deceleration that the base reaches."}};
  orca::Param<double> turn_acceleration_{
      *this, "turn_acceleration", 2.0, {.unit = "rad/s2", .min = 0.01, .text = "The same of its turn rate."}};
  orca::Param<double> max_turn_rate_{
      *this, "max_turn_rate", 1.0, {.unit = "rad/s", .min = 0.01, .text = "Largest turn rate."}};
  orca::Param<double> least_margin_{
      *this,
      "least_margin",
      0.05,
      {.unit = "m", .min = 0.0, .text = "Free space to keep at rest; it grows to margin at max_speed."}};
  orca::Param<double> leave_way_{
      *this,
      "leave_way",
      0.3,
      {.unit = "m",
       .min = 0.0,
       .text = "Free way that ends a turn on the spot, begun because no way ahead was free."}};
  orca::Param<double> heading_weight_{
      *this, "heading_weight", 2.0, {.min = 0.0, .text = "Weight of pointing to the goal (alpha)."}};
  orca::Param<double> distance_weight_{
      *this, "distance_weight", 2.0, {.min = 0.0, .text = "Weight of the free way (beta)."}};
  orca::Param<double> speed_weight_{
      *this, "speed_weight", 0.2, {.min = 0.0, .text = "Weight of the speed (gamma)."}};

  orca::dwa::State state_;
};

}  // namespace

ORCA_COMPONENT(Dwa, "orca.Dwa")
