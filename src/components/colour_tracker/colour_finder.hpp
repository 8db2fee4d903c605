// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "orca/image/colour.hpp"

namespace orca::colour {

/// A view of a picture of three bytes per pixel: red, green, blue.
struct Picture {
  std::span<const std::uint8_t> bytes;
  std::size_t width = 0;      ///< Pixels in a row.
  std::size_t height = 0;     ///< Number of rows.
  std::size_t step = 0;       ///< Bytes from one row to the next.
  double focal_length = 0.0;  ///< [pixels] Of a pinhole camera whose axis meets the middle of the picture.
};

/// The thing to look for: an upright round one on the floor, of one colour.
struct Wanted {
  Colour colour;
  double radius = 0.0;         ///< [m]
  double height = 0.0;         ///< [m]
  double camera_height = 0.0;  ///< [m] Of the camera above the floor.
};

/// The place where it was seen, from the camera.
struct Sighting {
  double bearing = 0.0;   ///< [rad] Of its middle, positive to the left of the camera's axis.
  double distance = 0.0;  ///< [m] To its middle.
};

/// Finds the thing in a picture: of all groups of adjacent columns with its colour, the one with most of it. Its width says how far it is, and
/// so does the height of its head. Things before it make it seem farther, never nearer, so the smaller distance counts. Its foot, which
/// swings as a person walks, counts only where the others are beyond the picture or say far more.
///
/// Colours are compared by the angle between them, so shade does not matter (Kruse et al., "The Spectral Image Processing System (SIPS)", Remote
/// Sensing of Environment 44, 1993: the spectral angle).
///
/// @return  nothing if it is not in the picture.
/// @pre     the picture's bytes are there: step * height of them, step at least 3 * width.
/// @thread  pure function; any thread.
[[nodiscard]] std::optional<Sighting> find_colour(const Picture& picture, const Wanted& wanted);

}  // namespace orca::colour
