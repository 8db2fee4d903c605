// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

namespace orca::fuse {

/// One behaviour's wish, of a kind that counts.
struct Wish {
  enum class Kind { direction, turn_rate, full_stop };
  Kind kind = Kind::direction;
  double value = 0.0;   ///< Direction [rad] or turn rate [rad/s], counter-clockwise positive.
  double speed = 0.0;   ///< [m/s]
  double weight = 0.0;  ///< [1] at least 0.
};

/// Weighted fusion (thesis 11.1): directions as the weighted sum of unit vectors, turn rates and speeds as
/// weighted means. Any full stop stops. If some wish with a weight is a turn rate, directions count as rates
/// of `steer_gain` times the direction. Directions that cancel out leave the robot standing.
///
/// @param steer_gain  [1/s]
/// @return the fused command, with the sum of the weights; nothing if no wish has any weight.
[[nodiscard]] std::optional<Wish> fuse_weighted(std::span<const Wish> wishes, double steer_gain);

}  // namespace orca::fuse
