// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "voice.hpp"

namespace orca::fuse {

/// Returns the turn rate [rad/s] that a wish asks for: a direction counts as `steer_gain` [1/s] times it.
[[nodiscard]] double as_rate(const Wish& wish, double steer_gain);

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

/// The parameters of the vote.
struct Ballot {
  double steer_gain = 0.0;     ///< [1/s] a direction is a vote for the turn rate of this times it.
  double max_turn_rate = 0.0;  ///< [rad/s] the candidates lie between this to the right and to the left.
  double rate_spread = 0.0;    ///< [rad/s] standard deviation of the bell that a wish is spread to.
  double speed_spread = 0.0;   ///< [m/s] likewise over the candidate speeds.
  double inertia = 0.0;        ///< [1] share of all votes that the last choice has in choosing between peaks.
};

/// Holds a vote (DAMN). Each wish gives votes to the candidate turn rates in proportion to its weight: most
/// to its own rate, and fewer to rates farther away. The candidate with most votes wins. The wishes that
/// voted for it, each in proportion to its votes, then choose the speed in the same way. A mean would drive
/// between two wishes, into the obstacle that both want to avoid; a vote takes one of them.
///
/// If there are several peaks, the last choice, `last_rate` [rad/s], has votes too. The robot then keeps to
/// its side while the behaviours speak one after the other. If peaks are equal, the one to the left wins.
///
/// @param wishes  at least one, each with a weight above 0.
/// @source  Rosenblatt, "DAMN: A Distributed Architecture for Mobile Navigation", J. Experimental and
///          Theoretical AI 9(2-3), 1997: command fusion by votes, smoothing and interpolation of the peak.
///          Our own addition: each behaviour gives one wish, which is spread to a bell here.
[[nodiscard]] Fused vote(std::span<const Wish> wishes, const Ballot& ballot, double last_rate);

}  // namespace orca::fuse
