// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithm.hpp"

#include <algorithm>
#include <cmath>

namespace orca::fuse {

std::optional<Wish> fuse_weighted(std::span<const Wish> wishes, double steer_gain) {
  const auto is = [](Wish::Kind kind) { return [kind](const Wish& wish) { return wish.kind == kind; }; };
  if (std::any_of(wishes.begin(), wishes.end(), is(Wish::Kind::full_stop)))
    return Wish{Wish::Kind::full_stop};
  const bool as_rate = std::any_of(wishes.begin(), wishes.end(), is(Wish::Kind::turn_rate));
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
  const double value = as_rate ? rate / weight : std::atan2(left, forward);
  return Wish{as_rate ? Wish::Kind::turn_rate : Wish::Kind::direction, value, speed / weight, weight};
}

}  // namespace orca::fuse
