// SPDX-License-Identifier: LGPL-3.0-or-later
#include "window.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/arc.hpp"

namespace orca::dwa {
namespace {

constexpr std::size_t kSpeeds = 9;
constexpr std::size_t kTurnRates = 21;
constexpr double kRest = 1e-9;  // [m/s], [rad/s] a slower velocity is none.

// One velocity of the window.
struct Cell {
  Twist2 motion;
  bool admissible = false;
  double value = 0.0;  // of the objective function, before it is smoothed
};

std::vector<double> evenly(double low, double high, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = std::lerp(low, high, static_cast<double>(i) / static_cast<double>(count - 1));
  return values;
}

// Puts 0 in the place of the value nearest to it, if it lies among them.
void include_zero(std::vector<double>& values) {
  if (values.front() > 0.0 || values.back() < 0.0) return;
  *std::ranges::min_element(values, {}, [](double value) { return std::abs(value); }) = 0.0;
}

double margin_at(double speed, const Settings& settings) {
  const double share = std::min(1.0, speed / settings.robot.max_speed);
  return std::lerp(std::min(settings.least_margin, settings.margin), settings.margin, share);
}

// The fastest at which the robot still comes to rest within that way: the condition of V_a, read for the goal.
double speed_to_stop(std::optional<double> way, const Abilities& robot) {
  return way ? std::min(robot.max_speed, std::sqrt(2.0 * robot.acceleration * std::max(0.0, *way)))
             : robot.max_speed;
}

Cell rated(const Twist2& motion, const Scene& scene, double least_way, const Settings& settings) {
  if (motion.forward < kRest && std::abs(motion.turn_rate) < kRest) return {motion};
  const Room room = room_on(motion, scene.echoes, settings);
  if (!can_stop(motion, room.time, settings.robot.brakes())) return {motion};
  if (motion.forward >= kRest && room.distance < least_way) return {motion};
  const Weights& weights = settings.weights;
  const double value = weights.heading * heading(motion, scene.target, settings) +
                       weights.distance * std::min(1.0, room.distance / settings.far) +
                       weights.speed * motion.forward / settings.robot.max_speed;
  return {motion, true, value};
}

// The velocities of a window, row by row of equal speed.
class Grid {
 public:
  Grid(const Window& window, const Scene& scene, double least_way, const Settings& settings)
      : columns_(window.turn_rates.size()) {
    for (const double speed : window.speeds)
      for (const double rate : window.turn_rates)
        cells_.push_back(rated({speed, 0.0, rate}, scene, least_way, settings));
  }

  [[nodiscard]] std::optional<Twist2> best() const {
    std::optional<Twist2> best;
    double most = 0.0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (!cells_[i].admissible) continue;
      const double value = smoothed(i);
      if (best && value <= most) continue;
      best = cells_[i].motion;
      most = value;
    }
    return best;
  }

 private:
  // The sigma of the objective function: the mean with the neighbours, of which those that are not admissible count as 0. This keeps the
  // robot off velocities next to such that touch something.
  [[nodiscard]] double smoothed(std::size_t i) const {
    const std::size_t row = i / columns_;
    const std::size_t column = i % columns_;
    double sum = 0.0;
    double weights = 0.0;
    for (std::size_t r = row - std::min<std::size_t>(row, 1); r < std::min(row + 2, rows()); ++r) {
      for (std::size_t c = column - std::min<std::size_t>(column, 1); c < std::min(column + 2, columns_);
           ++c) {
        const double weight = (r == row ? 2.0 : 1.0) * (c == column ? 2.0 : 1.0);
        sum += weight * cells_[r * columns_ + c].value;
        weights += weight;
      }
    }
    return sum / weights;
  }

  [[nodiscard]] std::size_t rows() const { return cells_.size() / columns_; }

  std::size_t columns_;
  std::vector<Cell> cells_;
};

}  // namespace

Window window_around(const Twist2& now, double max_speed, const Settings& settings) {
  const Abilities& robot = settings.robot;
  const double faster = robot.acceleration * settings.interval;
  const double sharper = robot.turn_acceleration * settings.interval;
  const double slowest = std::max(0.0, now.forward - faster);
  const double fastest = std::max(slowest, std::min(max_speed, now.forward + faster));
  const double rate = std::clamp(now.turn_rate, -robot.max_turn_rate, robot.max_turn_rate);
  Window window{evenly(slowest, fastest, kSpeeds),
                evenly(std::max(-robot.max_turn_rate, rate - sharper),
                       std::min(robot.max_turn_rate, rate + sharper), kTurnRates)};
  include_zero(window.turn_rates);
  return window;
}

Room room_on(const Twist2& motion, std::span<const Vec2> echoes, const Settings& settings) {
  const double margin = margin_at(motion.forward, settings);
  const double time = avoid::time_to_margin(echoes, motion, margin, settings.body);
  const double way = time * portable::hypot(motion.forward, motion.turn_rate * avoid::reach(settings.body));
  return {std::max(0.0, time - settings.reaction), way};
}

double heading(const Twist2& motion, Vec2 target, const Settings& settings) {
  const Abilities& robot = settings.robot;
  const Travel2 braking{0.5 * motion.forward * motion.forward / robot.acceleration, 0.0,
                        0.5 * motion.turn_rate * std::abs(motion.turn_rate) / robot.turn_acceleration};
  const Travel2 way = motion * settings.interval;
  const Pose2 at_rest = along_arc({}, {way.forward + braking.forward, 0.0, way.turn + braking.turn});
  const Vec2 seen = seen_from(at_rest, target);
  return 1.0 - std::abs(portable::atan2(seen.y, seen.x)) / std::numbers::pi;
}

std::optional<Twist2> best_velocity(const Twist2& now, const Scene& scene, double least_way,
                                    const Settings& settings) {
  const double fastest = speed_to_stop(scene.stop_within, settings.robot);
  return Grid(window_around(now, fastest, settings), scene, least_way, settings).best();
}

std::optional<Twist2> turn_on_the_spot(const Twist2& now, double side, std::span<const Vec2> echoes,
                                       const Settings& settings) {
  const Window window = window_around(now, settings.robot.max_speed, settings);
  if (window.speeds.front() >= kRest) return std::nullopt;
  std::optional<Twist2> fastest;
  for (const double rate : window.turn_rates) {
    const Twist2 turn{0.0, 0.0, rate};
    if (side * rate < kRest || (fastest && std::abs(rate) < std::abs(fastest->turn_rate))) continue;
    if (can_stop(turn, room_on(turn, echoes, settings).time, settings.robot.brakes())) fastest = turn;
  }
  return fastest;
}

Twist2 steer(const Twist2& now, const Scene& scene, double leave_way, const Settings& settings,
             State& state) {
  const bool turns = state.turning_to != 0.0;
  const auto best = best_velocity(now, scene, turns ? leave_way : 0.0, settings);
  if (best && best->forward >= kRest) {
    state.turning_to = 0.0;
    return *best;
  }
  if (!turns) state.turning_to = best && best->turn_rate < 0.0 ? -1.0 : 1.0;
  for (const double side : {state.turning_to, -state.turning_to}) {
    const auto turn = turn_on_the_spot(now, side, scene.echoes, settings);
    if (!turn) continue;
    state.turning_to = side;
    return *turn;
  }
  return {};
}

}  // namespace orca::dwa
