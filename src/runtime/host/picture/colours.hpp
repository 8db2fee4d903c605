// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <cstddef>

namespace orca::host {

/// A colour of a picture. Each part is from 0 to 1; an alpha of 1 is opaque.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;

  [[nodiscard]] Colour with_alpha(double share) const { return {red, green, blue, share}; }
};

inline constexpr Colour kInk{0.1, 0.1, 0.1};
inline constexpr Colour kPlaceGrey{0.45, 0.45, 0.45};
inline constexpr Colour kArrivalGreen{0.0, 0.55, 0.2};
inline constexpr Colour kContactRed{0.9, 0.0, 0.0};
inline constexpr Colour kSonarYellow{0.85, 0.65, 0.0};
inline constexpr Colour kLaserBlue{0.1, 0.3, 0.9};
inline constexpr Colour kMotionRed{0.85, 0.05, 0.05};

/// Returns the colour of a robot by its number in the scene. The first eight were chosen to look different;
/// the hues of further ones are spread evenly.
[[nodiscard]] Colour robot_colour(std::size_t number);

inline void set_colour(cairo_t* cairo, const Colour& colour) {
  cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, colour.alpha);
}

}  // namespace orca::host
