// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <numbers>
#include <vector>

#include "orca/avoidance/laser_avoider.hpp"
#include "orca/geometry/angle.hpp"
#include "steering.hpp"

namespace {

/// An avoid behaviour that keeps the robot from driving into what its laser sees, and finds its direction by VFH+
/// (Ulrich and Borenstein, ICRA 1998). See README.md.
class VfhPlus final : public orca::avoid::LaserAvoider {
 public:
  explicit VfhPlus(orca::ComponentHost& host) : LaserAvoider(host) {}

 private:
  orca::Status params_changed() override {
    if (*threshold_low_ > *threshold_high_)
      return threshold_low_.refuse("it must not be above threshold_high");
    return LaserAvoider::params_changed();
  }

  orca::Status start() override {
    state_ = {};
    return LaserAvoider::start();
  }

  // VFH+ chooses a direction in every lap, so that it remembers what it chose. It says it while the way ahead or the
  // way to the goal is not free: where only the latter is blocked, the robot would otherwise turn back into it.
  orca::avoid::Advice advice(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
                             const orca::avoid::Limits& given) override {
    const orca::avoid::Limits limits = with_body(memory.echoes(), situation, given);
    look_at(memory, situation, limits);
    const orca::vfh::Motion motion{situation.heading, std::max(0.0, situation.speed) / *turn_rate_};
    const double goal = situation.goal.value_or(0.0);
    const auto choice = orca::vfh::steer(cells_, motion, situation.heading + goal, settings(limits), state_);
    const double ahead = way_ahead(memory.echoes(), situation, limits);
    const double way = std::min(ahead, way_to_goal(memory.echoes(), situation, limits));
    const orca::avoid::TurnRoom turns = turn_room(memory.echoes(), situation, limits);
    const bool may_turn = turns.allows(goal);
    if (way >= limits.safe_distance && may_turn) return {};
    if (!choice) return {.needed = true, .urgency = 1.0};
    const double direction = turns.allowed(orca::wrapped(choice->direction - situation.heading));
    if (choice->at_rest) return {.needed = true, .direction = direction, .urgency = 1.0};
    return {true, direction, limits.max_speed * room(ahead, limits), urgency(way, may_turn, limits)};
  }

  // Takes the echoes over in axes that do not turn with the robot, as the sectors. Echoes that the robot cannot
  // touch before it is at the goal are not in the way there.
  void look_at(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
               const orca::avoid::Limits& limits) {
    const double farthest = situation.goal_distance + limits.robot_radius + limits.margin;
    cells_.clear();
    for (std::size_t i = 0; i < memory.echoes().size(); ++i) {
      const orca::Vec2 echo = memory.echoes()[i];
      if (norm(echo) <= farthest)
        cells_.push_back({rotated(echo, situation.heading), memory.certainty(i, keep())});
    }
  }

  [[nodiscard]] orca::vfh::Settings settings(const orca::avoid::Limits& limits) const {
    const double radius = (limits.squeezes ? limits.body->half_width : limits.robot_radius) + limits.margin;
    return {.around = {radius, radius + limits.safe_distance, *near_weight_},
            .thresholds = {*threshold_low_, *threshold_high_},
            .wide = *wide_valley_,
            .costs = {*goal_cost_, *heading_cost_, *last_cost_}};
  }

  orca::Param<double> turn_rate_{
      *this,
      "turn_rate",
      1.0,
      {.unit = "rad/s",
       .min = 0.01,
       .text = "Turn rate that the robot reaches; with its speed it gives the tightest arc it can drive."}};
  orca::Param<double> near_weight_{
      *this,
      "near_weight",
      5.0,
      {.min = 1.0,
       .text = "Magnitude of a fresh echo at the robot's centre (a); at the farthest that counts it is 1."}};
  orca::Param<double> threshold_low_{
      *this,
      "threshold_low",
      1.5,
      {.min = 0.0, .text = "Sum of magnitudes below which a blocked direction is free again."}};
  orca::Param<double> threshold_high_{
      *this,
      "threshold_high",
      2.5,
      {.min = 0.0, .text = "Sum of magnitudes above which a free direction is blocked."}};
  orca::Param<double> wide_valley_{
      *this,
      "wide_valley",
      1.4,
      {.unit = "rad",
       .min = 0.0,
       .max = std::numbers::pi,
       .text = "Width of an opening up to which its middle is taken; half of it is kept from the borders of "
               "wider ones."}};
  orca::Param<double> goal_cost_{
      *this,
      "goal_cost",
      5.0,
      {.min = 0.0,
       .text = "Cost of the angle between a direction and the goal; more than the other two together leads "
               "to the goal."}};
  orca::Param<double> heading_cost_{
      *this,
      "heading_cost",
      2.0,
      {.min = 0.0, .text = "Cost of the angle between a direction and where the robot points."}};
  orca::Param<double> last_cost_{
      *this,
      "last_cost",
      2.0,
      {.min = 0.0, .text = "Cost of the angle between a direction and the one chosen in the lap before."}};

  std::vector<orca::vfh::Cell> cells_;
  orca::vfh::State state_;
};

}  // namespace

ORCA_COMPONENT(VfhPlus, "orca.VfhPlus")
