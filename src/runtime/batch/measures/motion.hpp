// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/hw/scene.hpp"

namespace orca::batch {

/// Properties of one robot's motion, as pure functions of its steps, which are evenly spaced. None needs any step to be there, unless
/// it says so.

/// Returns whether the robot was carried off between two steps: it is farther away than it can drive.
[[nodiscard]] bool is_carried(const Scene::Step& one, const Scene::Step& next);
/// Returns the length of the way [m] that the robot drove.
[[nodiscard]] double way_of(std::span<const Scene::Step> steps);
/// Returns when the way reached this length [m], between two steps in proportion; nothing if it never did.
[[nodiscard]] std::optional<TimePoint> time_of_way(std::span<const Scene::Step> steps, double way);
/// Returns the steps from a time on.
[[nodiscard]] std::span<const Scene::Step> since(std::span<const Scene::Step> steps, TimePoint time);
/// Returns the diagonal of the box that holds all positions [m].
[[nodiscard]] double extent_of(std::span<const Scene::Step> steps);
/// The mean velocity over half a second, in which slips of the wheels even out.
struct Stretch {
  double forward = 0.0;    ///< [m/s]
  double turn_rate = 0.0;  ///< [rad/s]
};
inline constexpr std::size_t kStretch = 5;  ///< Steps of a Stretch.

/// Returns the stretches that follow each other.
[[nodiscard]] std::vector<Stretch> stretches_of(std::span<const Scene::Step> steps);
/// Returns the angle of all turns of half a second each, to either side [rad]. The last steps that make up no half second do not count.
[[nodiscard]] double turn_of(std::span<const Scene::Step> steps);
/// Returns the integral of the clearance over the way [m2], linear between steps.
[[nodiscard]] double area_under_clearance(std::span<const Scene::Step> steps);
/// Returns how often a turn to one side followed one to the other. Turns slower than 0.1 rad/s count as straight on.
[[nodiscard]] std::size_t reversals_in(std::span<const Stretch> stretches);
/// Adds the second differences of the forward speed by the square of the time between two stretches [m/s3].
void add_jerks(std::span<const Stretch> stretches, double period, std::vector<double>& jerks);
/// Returns the speed [m/s] in the last step before a time; 0 if there is none.
[[nodiscard]] double speed_before(std::span<const Scene::Step> steps, TimePoint time);

/// Returns the root of the mean of the squares. @pre  there are some.
[[nodiscard]] double root_mean_square(const std::vector<double>& values);

}  // namespace orca::batch
