// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/image/grey_image.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim {

using image::GreyImage;

/// The scale of an occupancy bitmap. Exactly one of the two must be set.
struct BitmapScale {
  std::optional<double> map_width;   ///< [m] Width of the whole picture, > 0.
  std::optional<double> resolution;  ///< [m] Side of one pixel, > 0.
};

/// Returns what is doubtful about a picture of which grey below 128 is solid: that much of it is light grey, away from what is
/// solid, as where walls are drawn in light grey, or not known in a map of ROS. Nothing if all of it is clear.
[[nodiscard]] std::optional<std::string> doubt_about(const GreyImage& image);

/// Returns the side of a pixel of the picture [m].
///
/// @errors  invalid_argument if the scale is missing, given twice or not positive, or if the map is wider or
///          higher than 100 km.
[[nodiscard]] Result<double> pixel_size(const BitmapScale& scale, const GreyImage& image);

/// Returns the boundary of the dark area as exact axis-aligned edges; neighbouring edges are merged to runs.
///
/// Grey below 128 is occupied. The lower left corner of the picture is the origin, so the first row of the
/// image lies at the largest y.
///
/// @param pixel [m]  side of one pixel.
/// @errors  invalid_argument if there are more than 2,000,000 edges: the picture is noise, not a plan.
[[nodiscard]] Result<Outline> outline_of(const GreyImage& image, double pixel);

/// Returns a picture as a world with one obstacle, "map", of the given height, and no places.
///
/// @param pixel  [m] side of one pixel, > 0.
/// @param height [m]  height of the dark area above the floor, > 0.
/// @errors  those of outline_of; invalid_argument if no pixel is solid.
[[nodiscard]] Result<WorldModel> bitmap_world(const GreyImage& image, double pixel, const std::string& name,
                                              double height = 2.5);

/// Reads an occupancy bitmap as such a world, named after its file.
///
/// @param doubt  receives what doubt_about() says; null: nobody wants to know.
/// @errors  those of image::read_image, pixel_size and bitmap_world.
[[nodiscard]] Result<WorldModel> read_bitmap_world(const std::string& path, const BitmapScale& scale,
                                                   double height = 2.5,
                                                   std::optional<std::string>* doubt = nullptr);

}  // namespace orca::sim
