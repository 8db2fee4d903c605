// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walk.hpp"

#include <limits>

namespace orca::walk {
namespace {

double end_of_way(double begin, const Limits& limits, RandomStream& random) {
  if (limits.longest_way <= 0.0) return std::numeric_limits<double>::infinity();
  return begin + random.uniform(0.0, limits.longest_way);
}

}  // namespace

void Walk::begin_turn(double time, const Limits& limits, RandomStream& random) {
  side_ = random.chance(0.5) ? 1.0 : -1.0;
  turn_until_ = time + random.uniform(limits.least_turn, limits.greatest_turn) / limits.turn_rate;
  drive_until_ = end_of_way(turn_until_, limits, random);
}

Step Walk::step(double time, double free_way, const Limits& limits, RandomStream& random) {
  if (!begun_) drive_until_ = end_of_way(time, limits, random);
  begun_ = true;
  const bool turning = time < turn_until_;
  if (!turning && (free_way <= limits.blocked_at || time >= drive_until_)) begin_turn(time, limits, random);
  if (time < turn_until_) return {side_ * limits.turn_rate, 0.0};
  return {0.0, limits.speed};
}

}  // namespace orca::walk
