// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "orca/geometry/vec2.hpp"

namespace orca::batch {

/// The values of a variant for a plot of their distribution.
struct Series {
  std::string name;
  std::vector<double> values;
  std::size_t runs = 0;  ///< Of which some have no value: the curve does not reach 1 then.
};

/// Returns the share of the runs whose value is at most x, as a stepped line for each series. @pre  one has a value.
[[nodiscard]] std::string distribution_plot(const std::string& axis, const std::vector<Series>& all);

/// A line on a map.
struct Line {
  Vec2 from, to;  ///< [m] in the world.
};
/// Where a robot went, on a map.
struct Track {
  std::vector<Vec2> places;  ///< [m] in the world.
  std::size_t variant = 0;   ///< Whose colour it gets.
  bool ends_badly = false;   ///< Marks its last place.
};

/// Returns a map with tracks. @pre  there is a line or a place.
[[nodiscard]] std::string map_plot(const std::vector<Line>& walls, const std::vector<Track>& tracks);

/// Returns the names of variants with their colours, for the lines of a map.
[[nodiscard]] std::string legend_plot(const std::vector<std::string>& variants);

/// Reads what track_text() has written: the places of each robot. What is no place is left out.
[[nodiscard]] std::vector<std::vector<Vec2>> read_tracks(const std::string& text);

}  // namespace orca::batch
