// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "histogram.hpp"

/// The fourth stage of VFH+, and all four of them in a row. Frames, source and threads: see histogram.hpp.
namespace orca::vfh {

/// An opening between blocked sectors: k_r is its rightmost free sector, k_l its leftmost.
struct Valley {
  std::size_t right = 0;  ///< k_r.
  std::size_t width = 0;  ///< Number of free sectors, counted to the left; kSectors: nothing is blocked.
};

/// The directions that another one is compared to.
struct Aim {
  double target = 0.0;         ///< [rad] k_t: to the goal.
  double heading = 0.0;        ///< [rad] theta: where the robot points.
  std::optional<double> last;  ///< [rad] k_d: chosen the last time, if any.
};

/// The weights of the cost function.
struct Costs {
  double target = 5.0;   ///< mu_1: of the angle between a direction and the goal.
  double heading = 2.0;  ///< mu_2: of the angle that the robot must turn.
  double last = 2.0;     ///< mu_3: of the angle to the direction chosen the last time.
};

/// The settings, which do not change from lap to lap.
struct Settings {
  Surroundings around;
  Thresholds thresholds;
  double wide = 0.0;  ///< [rad] s_max: a wider valley is a wide one.
  Costs costs;
};

/// The memory of VFH+ from one lap to the next.
struct State {
  Blocked blocked;             ///< The binary polar histogram.
  std::optional<double> last;  ///< [rad] the direction that was chosen.
};

/// A direction that the robot can take.
struct Choice {
  double direction = 0.0;  ///< [rad]
  bool at_rest = false;    ///< Whether the robot must stop to turn there: its arcs at this speed are blocked.
};

/// Returns the valleys from sector 0 on, counted to the left.
[[nodiscard]] std::vector<Valley> valleys(const Blocked& blocked);

/// Returns the directions [rad] that a valley offers: of a narrow one its middle (equation 12); of a wide one those
/// half of `wide` inside its borders, and the target if it lies between these (equation 13). If nothing is blocked:
/// the target.
[[nodiscard]] std::vector<double> candidates(const Valley& valley, double target, double wide);

/// Returns the cost of a direction: equation 14, by angles [rad] instead of numbers of sectors. Without a last
/// direction its term is 0.
[[nodiscard]] double cost(double direction, const Aim& aim, const Costs& costs);

/// Returns the cheapest direction of all valleys; nothing if all sectors are blocked.
[[nodiscard]] std::optional<double> cheapest(const Blocked& blocked, const Aim& aim, double wide,
                                             const Costs& costs);

/// Does one lap of VFH+ and notes in `state` what the next one needs.
///
/// If the arcs at this speed leave no direction free, directions to which the robot can turn at rest are tried: the
/// paper's slower speed. Returns nothing if these are blocked too: the robot must stop.
/// @param target [rad]  to the goal; without a goal the heading.
[[nodiscard]] std::optional<Choice> steer(std::span<const Cell> cells, const Motion& motion, double target,
                                          const Settings& settings, State& state);

}  // namespace orca::vfh
