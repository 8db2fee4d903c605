// SPDX-License-Identifier: LGPL-3.0-or-later
#include "motion.hpp"

#include <algorithm>
#include <cmath>

#include "orca/geometry/angle.hpp"

namespace orca::batch {
namespace {

constexpr double kTurns = 0.1;  // [rad/s]
constexpr double kJump = 1.0;   // [m] in a tenth of a second

double way_between(const Scene::Step& one, const Scene::Step& next) {
  return is_carried(one, next) ? 0.0 : norm(next.pose.position() - one.pose.position());
}

}  // namespace

bool is_carried(const Scene::Step& one, const Scene::Step& next) {
  return norm(next.pose.position() - one.pose.position()) > kJump;
}

double way_of(std::span<const Scene::Step> steps) {
  double way = 0.0;
  for (std::size_t i = 1; i < steps.size(); ++i) way += way_between(steps[i - 1], steps[i]);
  return way;
}

std::optional<TimePoint> time_of_way(std::span<const Scene::Step> steps, double way) {
  double so_far = 0.0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double next = way_between(steps[i - 1], steps[i]);
    if (so_far + next >= way && next > 0.0) {
      const double share = (way - so_far) / next;
      return steps[i - 1].time + from_seconds(share * to_seconds(steps[i].time - steps[i - 1].time));
    }
    so_far += next;
  }
  return std::nullopt;
}

std::span<const Scene::Step> since(std::span<const Scene::Step> steps, TimePoint time) {
  const auto first = std::ranges::lower_bound(steps, time, {}, &Scene::Step::time);
  return {first, steps.end()};
}

double extent_of(std::span<const Scene::Step> steps) {
  if (steps.empty()) return 0.0;
  Vec2 low = steps.front().pose.position();
  Vec2 high = low;
  for (const Scene::Step& step : steps) {
    low = {std::min(low.x, step.pose.x), std::min(low.y, step.pose.y)};
    high = {std::max(high.x, step.pose.x), std::max(high.y, step.pose.y)};
  }
  return norm(high - low);
}

std::vector<Stretch> stretches_of(std::span<const Scene::Step> steps) {
  std::vector<Stretch> stretches;
  for (std::size_t i = kStretch; i < steps.size(); i += kStretch) {
    const Scene::Step& from = steps[i - kStretch];
    const Scene::Step& to = steps[i];
    const double period = to_seconds(to.time - from.time);
    const double turn = wrapped(to.pose.yaw - from.pose.yaw);
    const Vec2 way = to.pose.position() - from.pose.position();
    const double ahead = dot(way, direction(from.pose.yaw + 0.5 * turn));
    stretches.push_back({ahead / period, turn / period});
  }
  return stretches;
}

double turn_of(std::span<const Scene::Step> steps) {
  double turn = 0.0;
  for (std::size_t i = kStretch; i < steps.size(); i += kStretch)
    turn += std::fabs(wrapped(steps[i].pose.yaw - steps[i - kStretch].pose.yaw));
  return turn;
}

double area_under_clearance(std::span<const Scene::Step> steps) {
  double area = 0.0;
  for (std::size_t i = 1; i < steps.size(); ++i)
    area += way_between(steps[i - 1], steps[i]) * 0.5 * (steps[i - 1].clearance_m + steps[i].clearance_m);
  return area;
}

std::size_t reversals_in(std::span<const Stretch> stretches) {
  std::size_t count = 0;
  double last = 0.0;
  for (const Stretch& stretch : stretches) {
    if (std::fabs(stretch.turn_rate) < kTurns) continue;
    if (last * stretch.turn_rate < 0.0) ++count;
    last = stretch.turn_rate;
  }
  return count;
}

void add_jerks(std::span<const Stretch> stretches, double period, std::vector<double>& jerks) {
  for (std::size_t i = 2; i < stretches.size(); ++i) {
    const double difference =
        stretches[i].forward - 2.0 * stretches[i - 1].forward + stretches[i - 2].forward;
    jerks.push_back(difference / (period * period));
  }
}

double speed_before(std::span<const Scene::Step> steps, TimePoint time) {
  const auto after = std::ranges::lower_bound(steps, time, {}, &Scene::Step::time);
  if (after == steps.begin()) return 0.0;
  const Twist2& velocity = std::prev(after)->velocity;
  return norm(Vec2{velocity.forward, velocity.left});
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace orca::batch
