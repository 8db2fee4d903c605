// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "map_header.hpp"
#include "orca/base/result.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/image/grey_image.hpp"

namespace orca::maps {

/// Checks that a picture is one of a map.
/// @param path  of the picture, only for errors.
/// @errors  invalid_argument with what is wrong and what to do.
/// @thread  pure function; any thread.
[[nodiscard]] Status check_picture(const image::GreyImage& image, MapMode mode, const std::string& path);

/// Returns the map of a picture that has passed check_picture(). What is transparent is not known.
/// @thread  pure function; any thread.
[[nodiscard]] idl::OccupancyGrid map_of(const image::GreyImage& image, const MapHeader& header);

/// Returns the picture of a map, mode trinary.
/// @pre  the map has as many cells as it has columns times rows, at least one.
/// @thread  pure function; any thread.
[[nodiscard]] image::GreyImage picture_of(const idl::OccupancyGrid& map);

}  // namespace orca::maps
