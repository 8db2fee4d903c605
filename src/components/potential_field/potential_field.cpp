// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <span>

#include "force.hpp"
#include "orca/avoidance/laser_avoider.hpp"

namespace {

/// A behaviour that drives the robot down an artificial potential field (Khatib, 1986): the goal attracts it, what its laser
/// sees repels it. See README.md.
class PotentialField final : public orca::avoid::LaserAvoider {
 public:
  explicit PotentialField(orca::ComponentHost& host) : LaserAvoider(host, {.hidden = true}) {}

 private:
  // With a goal it drives alone: all it says has full weight. Within reach of the goal, and without one, it speaks where
  // something repels the robot.
  orca::avoid::Advice advice(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
                             const orca::avoid::Limits& limits) override {
    const orca::field::Settings settings = this->settings(limits);
    const orca::Vec2 repelled = orca::field::repulsion(memory.echoes(), settings);
    const bool drives = situation.goal && situation.goal_distance >= situation.goal_reach;
    if (!drives && repelled == orca::Vec2{}) return {};
    const orca::Vec2 goal = situation.goal ? situation.goal_distance * orca::direction(*situation.goal)
                                           : orca::Vec2{kStraightOn, 0.0};
    const orca::Vec2 force = attraction(goal, settings) + repelled;
    const orca::field::Course wanted = course(velocity(force, settings), settings);
    return safe(wanted, memory.echoes(), situation);
  }

  // The field moves a point. The body follows it as far as it can stop before it touches what the laser sees: slower, and
  // without so much of its turn if that does not help. While it drives that holds for the turn that it makes now as well.
  [[nodiscard]] orca::avoid::Advice safe(const orca::field::Course& wanted,
                                         std::span<const orca::Vec2> echoes,
                                         const orca::avoid::Situation& situation) const {
    const double rate = std::clamp(kTurnGain * wanted.direction, -kMaxTurnRate, kMaxTurnRate);
    const orca::avoid::Footprint outline = this->outline();
    const auto stops = [&](const orca::Twist2& motion) {
      return can_stop(motion, orca::avoid::time_to_margin(echoes, motion, kMargin, outline) - reaction_time(),
                      kBrakes);
    };
    for (const double turning : {1.0, 0.5, 0.0}) {
      for (const double driving : {1.0, 0.75, 0.5, 0.25, 0.0}) {
        const orca::Twist2 slower{driving * wanted.speed, 0.0, turning * rate};
        const orca::Twist2 at_first{slower.forward, 0.0, situation.turn_rate};
        if (stops(slower) && (driving == 0.0 || stops(at_first)))
          return {true, wanted.direction, slower.forward, 1.0, slower.turn_rate};
      }
    }
    return {true, 0.0, 0.0, 1.0, 0.0};
  }

  [[nodiscard]] orca::field::Settings settings(const orca::avoid::Limits& limits) const {
    return {*attraction_, *repulsion_, *influence_, *damping_, limits.max_speed, outline()};
  }

  static constexpr double kStraightOn = 100.0;  // [m]
  static constexpr double kMargin = 0.05;       // [m] kept free around the body
  static constexpr orca::avoid::Brakes kBrakes{0.5, 2.0};
  static constexpr double kTurnGain = 1.0;  // [1/s]
  static constexpr double kMaxTurnRate =
      1.5;  // [rad/s] at which a slow scan still shows places about where they are

  orca::Param<double> attraction_{
      *this,
      "attraction",
      1.0,
      {.unit = "1/s2", .min = 0.0, .text = "Acceleration towards the goal per metre to it (k_p)."}};
  orca::Param<double> repulsion_{
      *this,
      "repulsion",
      0.003,
      {.unit = "m4/s2", .min = 0.0, .text = "Strength of the field around each echo (eta)."}};
  orca::Param<double> influence_{
      *this,
      "influence",
      0.6,
      {.unit = "m",
       .min = 0.01,
       .text = "Distance from the body beyond which an echo does not repel (rho_0)."}};
  orca::Param<double> damping_{
      *this, "damping", 1.0, {.unit = "1/s", .min = 0.01, .text = "Deceleration per speed (k_v)."}};
};

}  // namespace

ORCA_COMPONENT(PotentialField, "orca.PotentialField")
