// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <functional>
#include <set>

#include "orca/host/picture.hpp"

namespace orca::host {

/// A picture that can be drawn: its size, and the function that draws it.
struct Drawing {
  double width = 0.0;   ///< [pixels]
  double height = 0.0;  ///< [pixels]
  std::function<void(cairo_t*)> draw;
};

/// Return the drawing for each View. The drawings hold references to the arguments.
/// @errors  invalid_argument: there is nothing to show.
[[nodiscard]] Result<Drawing> world_view(const Scene& scene, const std::set<Layer>& hidden);
[[nodiscard]] Result<Drawing> robot_view(const Scene& scene, const std::set<Layer>& hidden);
[[nodiscard]] Result<Drawing> film(const Scene& scene, const std::set<Layer>& hidden);

}  // namespace orca::host
