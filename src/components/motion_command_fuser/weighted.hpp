// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "wish.hpp"

namespace orca::fuse {

/// Weighted fusion (thesis 11.1): directions as the weighted sum of unit vectors, turn rates and speeds as
/// weighted means. If some wish is a turn rate, directions count as rates of `steer_gain` times the
/// direction. Directions that cancel out leave the robot standing.
///
/// @param wishes      at least one, each with a weight above 0.
/// @param steer_gain  [1/s]
[[nodiscard]] Fused fuse_weighted(std::span<const Wish> wishes, double steer_gain);

/// Motor schemas: each wish is a vector in its direction, as long as its weight; the sum is normalised by the
/// weights. Its length, 1 where all agree and 0 where they cancel out, is the share of the mean speed that
/// the robot drives. Turn rates count as directions of the rate divided by `steer_gain`.
///
/// @source  Arkin, "Motor schema-based mobile robot navigation", Int. J. Robotics Research 8(4), 1989: the
///          vectors of all schemas are summed and normalised. That the length takes part as a share of the
///          speed is our own.
[[nodiscard]] Fused sum_vectors(std::span<const Wish> wishes, double steer_gain);

}  // namespace orca::fuse
