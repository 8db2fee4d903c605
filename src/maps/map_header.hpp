// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::maps {

/// How the greys of a map's picture become cells.
enum class MapMode {
  trinary,  ///< Occupied, free or not known.
  scale,    ///< The same, and per cent between the thresholds.
  raw,      ///< Grey 0 to 100 is per cent, more is not known.
};

/// The content of a YAML file of ROS's map_server.
struct MapHeader {
  std::string image;            ///< File of the picture, seen from the YAML file's folder.
  double resolution = 0.0;      ///< [m] side of a pixel, > 0.
  Pose2 corner;                 ///< Outer corner of the lowest left pixel, map frame.
  bool negate = false;          ///< White is occupied.
  double occupied_from = 0.65;  ///< Darkness, 0 white to 1 black, above which a cell is occupied.
  double free_to = 0.196;       ///< Darkness below which it is free; at most the other.
  MapMode mode = MapMode::trinary;
};

/// Reads such a file.
/// @param path  only for errors.
/// @errors  invalid_argument with file, line and what to do.
/// @thread  pure function; any thread.
[[nodiscard]] Result<MapHeader> parse_header(std::string_view text, const std::string& path);

/// Returns whether the side of a cell [m] is one that a map may have.
[[nodiscard]] bool is_side(double resolution);

/// Returns what is wrong with another one, as the end of a sentence about it.
[[nodiscard]] std::string wrong_side(double resolution);

/// Returns whether a map may have its corner there.
[[nodiscard]] bool is_corner(const Pose2& corner);

/// Returns whether the file of a picture may have this name: it holds no control characters.
[[nodiscard]] bool is_file_name(std::string_view name);

/// Returns the text of such a file.
/// @pre  is_file_name(header.image).
[[nodiscard]] std::string header_text(const MapHeader& header);

}  // namespace orca::maps
