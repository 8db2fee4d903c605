// SPDX-License-Identifier: LGPL-3.0-or-later
#include "weighted.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"

namespace orca::fuse {
namespace {

// Unit vectors whose weighted sum is shorter than this share of the weights cancel out: the remainder is
// rounding, not a direction.
constexpr double kCancelled = 1e-9;

struct Sums {
  double weight = 0.0;
  double speed = 0.0;
  double rate = 0.0;
  double forward = 0.0;
  double left = 0.0;
};

double as_rate(const Wish& wish, double steer_gain) {
  return wish.kind == Wish::Kind::direction ? steer_gain * wish.value : wish.value;
}

double as_direction(const Wish& wish, double steer_gain) {
  if (wish.kind == Wish::Kind::direction) return wish.value;
  return std::clamp(wish.value / steer_gain, -std::numbers::pi, std::numbers::pi);
}

Sums sums_of(std::span<const Wish> wishes, double steer_gain) {
  Sums sums;
  for (const Wish& wish : wishes) {
    const double direction = as_direction(wish, steer_gain);
    sums.weight += wish.weight;
    sums.speed += wish.weight * wish.speed;
    sums.rate += wish.weight * as_rate(wish, steer_gain);
    const auto [cosine, sine] = portable::cos_sin(direction);
    sums.forward += wish.weight * cosine;
    sums.left += wish.weight * sine;
  }
  return sums;
}

std::vector<double> shares_of(std::span<const Wish> wishes, double weight) {
  std::vector<double> shares;
  for (const Wish& wish : wishes) shares.push_back(wish.weight / weight);
  return shares;
}

// Returns a wish in the direction of the sum, at this speed; standing if the vectors cancel out.
Wish along(const Sums& sums, double speed) {
  if (portable::hypot(sums.forward, sums.left) < kCancelled * sums.weight)
    return {Wish::Kind::direction, 0.0, 0.0, sums.weight};
  return {Wish::Kind::direction, portable::atan2(sums.left, sums.forward), speed, sums.weight};
}

}  // namespace

Fused fuse_weighted(std::span<const Wish> wishes, double steer_gain) {
  const auto turns = [](const Wish& wish) { return wish.kind == Wish::Kind::turn_rate; };
  const Sums sums = sums_of(wishes, steer_gain);
  const double speed = sums.speed / sums.weight;
  const bool by_rate = std::any_of(wishes.begin(), wishes.end(), turns);
  return {
      by_rate ? Wish{Wish::Kind::turn_rate, sums.rate / sums.weight, speed, sums.weight} : along(sums, speed),
      shares_of(wishes, sums.weight)};
}

Fused sum_vectors(std::span<const Wish> wishes, double steer_gain) {
  const Sums sums = sums_of(wishes, steer_gain);
  const double agreement = std::min(1.0, portable::hypot(sums.forward, sums.left) / sums.weight);
  return {along(sums, agreement * sums.speed / sums.weight), shares_of(wishes, sums.weight)};
}

}  // namespace orca::fuse
