// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drawing.hpp"
#include "orca/geometry/vec2.hpp"

namespace orca::batch {

/// The values of a variant for a plot of their distribution.
struct Series {
  std::string name;
  std::vector<double> values;
  std::size_t runs = 0;  ///< If some of them have no value, the curve does not reach 1.
};

/// Returns the share of the runs whose value is at most x, as a stepped line for each series. @pre  one has a value.
[[nodiscard]] Drawing distribution_plot(const std::string& axis, const std::vector<Series>& all);

/// The way of a robot on a map.
struct Track {
  Places places;
  std::size_t variant = 0;  ///< Whose colour it gets.
  bool ends_badly = false;  ///< Marks its last place.
};

/// The map of a world as it is drawn.
struct Map {
  std::vector<Places> walls{};
  std::vector<Track> tracks{};
  Places contacts{};  ///< Each gets a cross.
};

/// Returns a map. @pre  there is a wall or a track with a place.
[[nodiscard]] Drawing map_plot(const Map& map);

/// Returns the names of variants with their colours, for the lines of a map.
[[nodiscard]] Drawing legend_plot(const std::vector<std::string>& variants);

/// Reads lines of a Sketch. Words that are no place are left out; there is no line without a place.
[[nodiscard]] std::vector<Places> read_lines(const std::string& text);

}  // namespace orca::batch
