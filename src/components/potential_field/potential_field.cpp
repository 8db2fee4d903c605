// SPDX-License-Identifier: LGPL-3.0-or-later
#include "force.hpp"
#include "orca/avoidance/laser_avoider.hpp"

namespace {

/// A behaviour that drives the robot down an artificial potential field (Khatib, 1986): the goal attracts it, what its laser
/// sees repels it. See README.md.
class PotentialField final : public orca::avoid::LaserAvoider {
 public:
  explicit PotentialField(orca::ComponentHost& host) : LaserAvoider(host) {}

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
    return {true, wanted.direction, wanted.speed, 1.0};
  }

  [[nodiscard]] orca::field::Settings settings(const orca::avoid::Limits& limits) const {
    orca::field::Outline outline{limits.robot_radius};
    if (const auto rectangle = body())
      outline = {limits.robot_radius, rectangle->half_length, rectangle->half_width};
    return {*attraction_, *repulsion_, *influence_, *damping_, limits.max_speed, outline};
  }

  static constexpr double kStraightOn = 100.0;  // [m]

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
