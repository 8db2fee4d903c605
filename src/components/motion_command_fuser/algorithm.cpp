// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithm.hpp"

#include <algorithm>
#include <cmath>

namespace orca::fuse {
namespace {

// Unit vectors whose weighted sum is shorter than this share of the weights cancel out: what is left of them
// is rounding, and no direction.
constexpr double kCancelled = 1e-9;

}  // namespace

std::optional<Wish> fuse_weighted(std::span<const Wish> wishes, double steer_gain) {
  const auto stops = [](const Wish& wish) { return wish.kind == Wish::Kind::full_stop; };
  const auto turns = [](const Wish& wish) { return wish.kind == Wish::Kind::turn_rate && wish.weight > 0.0; };
  if (std::any_of(wishes.begin(), wishes.end(), stops)) return Wish{Wish::Kind::full_stop};
  const bool as_rate = std::any_of(wishes.begin(), wishes.end(), turns);
  double weight = 0.0;
  double speed = 0.0;
  double rate = 0.0;
  double forward = 0.0;
  double left = 0.0;
  for (const Wish& wish : wishes) {
    weight += wish.weight;
    speed += wish.weight * wish.speed;
    rate += wish.weight * (wish.kind == Wish::Kind::direction ? steer_gain * wish.value : wish.value);
    forward += wish.weight * std::cos(wish.value);
    left += wish.weight * std::sin(wish.value);
  }
  if (weight <= 0.0) return std::nullopt;
  if (as_rate) return Wish{Wish::Kind::turn_rate, rate / weight, speed / weight, weight};
  if (std::hypot(forward, left) < kCancelled * weight) return Wish{Wish::Kind::direction, 0.0, 0.0, weight};
  return Wish{Wish::Kind::direction, std::atan2(left, forward), speed / weight, weight};
}

}  // namespace orca::fuse
