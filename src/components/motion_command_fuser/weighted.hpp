// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "wish.hpp"

namespace orca::fuse {

/// Fuses wishes by their weights (thesis 11.1): directions as the weighted sum of unit vectors, turn rates
/// and speeds as weighted means. If some wish is a turn rate, directions count as rates of `steer_gain` times
/// the direction. If the directions cancel out, the robot stands.
///
/// @param wishes      at least one, each with a weight above 0.
/// @param steer_gain  [1/s]
[[nodiscard]] Fused fuse_weighted(std::span<const Wish> wishes, double steer_gain);

/// Sums wishes as motor schemas. Each wish is a vector in its direction, as long as its weight; the sum is
/// normalised by the weights. The length of the sum is 1 where all agree and 0 where they cancel out. It is
/// the share of the mean speed that the robot drives. Turn rates count as directions of the rate divided by
/// `steer_gain`.
///
/// @source  Arkin, "Motor schema-based mobile robot navigation", Int. J. Robotics Research 8(4), 1989: the
///          vectors of all schemas are summed and normalised. Our own addition: the length counts as a share
///          of the speed.
[[nodiscard]] Fused sum_vectors(std::span<const Wish> wishes, double steer_gain);

}  // namespace orca::fuse
