// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/idl/navigation.hpp"

namespace orca::maps {

inline constexpr std::size_t kMostCells =
    25'000'000;  ///< of a map that is read: 250 m by 250 m in cells of 5 cm.

inline constexpr double kLeastSide = 0.001;        ///< [m] of a cell of a map that is read.
inline constexpr double kMostSide = 10.0;          ///< [m] the same at most.
inline constexpr std::size_t kMostAlong = 40'000;  ///< [cells] of its width and of its height.
inline constexpr double kMostExtent = 2000.0;      ///< [m] of its width and of its height.
inline constexpr double kMostDistance =
    100'000.0;  ///< [m] of its corner from the frame's origin, along x and along y.

/// Reads a map: a YAML file of ROS's map_server with its picture, or a picture alone.
///
/// Row 0 of the map is the lowest of the picture, so y points up (REP 105). The file's `origin` is the outer corner of cell 0 in the
/// map frame, with its yaw; a picture alone has that corner at (0, 0), and grey below 128 is occupied, all else free, as in a world of the
/// simulator. The name is the file's, without folder and ending. The stamp of the corner is 0.
///
/// @param resolution [m]  side of a pixel of a picture alone; 0: a YAML file says it.
/// @errors  not_found if a file cannot be opened; data_loss if one is damaged; invalid_argument with what is wrong and what to do: keys
///          that are missing, misspelt, given twice or no numbers, a resolution that is missing or out of its range, a corner that is too far away, a map that is too wide or high, a picture in colours, of 16
///          bits, of more than kMostCells pixels, with width and height exchanged, or a photograph.
/// @thread  any.
[[nodiscard]] Result<idl::OccupancyGrid> read_map(const std::string& path, double resolution = 0.0);

/// Returns what makes it doubtful that a map is the right one, or read as it was meant: nothing in it is occupied or free, or more is
/// occupied than free. Nothing if all of it is clear.
/// @thread  pure function; any thread.
[[nodiscard]] std::optional<std::string> doubt_about(const idl::OccupancyGrid& map);

/// The files of a map, as write_map() makes them.
struct MapTexts {
  std::string picture;  ///< A PNG file: 0 occupied, 254 free, 205 not known.
  std::string header;   ///< The YAML file of ROS's map_server beside it.
};

/// Returns the files of a map. Cells from 65 % on are occupied, up to 19 % free; others are not known.
/// @param picture_name  of the picture's file, as the YAML file is to name it.
/// @errors  invalid_argument if the map has no cells, not as many as its size says, or a resolution or a corner that read_map()
///          would refuse, or if the name holds control characters. A map that is larger than read_map() takes is no error.
/// @thread  pure function; any thread.
[[nodiscard]] Result<MapTexts> texts_of(const idl::OccupancyGrid& map, std::string_view picture_name);

/// Writes a map as NAME.png and NAME.yaml, which read_map() and the tools of ROS read. Both are whole, or neither is there.
/// @param name  path without an ending; one of ".yaml" is left out.
/// @errors  already_exists if one of the files does; those of texts_of(); unavailable with the system's reason.
/// @thread  any.
[[nodiscard]] Status write_map(const idl::OccupancyGrid& map, const std::string& name);

}  // namespace orca::maps
