// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cone.hpp"
#include "elements.hpp"
#include "orca/sim/caster.hpp"
#include "regions.hpp"

namespace orca::sim::detail {

class Panorama;

// The boundaries that never move, sorted into the cells of uniform grids, one per region of the plane.
class Grid {
 public:
  explicit Grid(Elements elements) : elements_(std::move(elements)), regions_(elements_) {}

  // Replaces the hit, with its element number, by the nearest element on the ray if that is closer.
  // @pre  the ray meets no element before `from` [m].
  void cast(const Ray& ray, Hit& hit, double from = 0.0) const;

  // Returns a distance [m] before which no ray of the cone meets anything. The true one may be larger.
  [[nodiscard]] double empty_depth(const Cone& cone) const;

  // Adds to the view of a cone all elements that can be seen in it, and perhaps some that cannot. An element's
  // number is `first` plus `step` times its number here.
  void show(const Cone& cone, std::uint64_t first, std::uint64_t step, Panorama& view) const;

  [[nodiscard]] const Regions& regions() const { return regions_; }

 private:
  void show_part(const Cone& cone, std::uint64_t first, std::uint64_t step, Panorama& view) const;

  Elements elements_;
  Regions regions_;
};

}  // namespace orca::sim::detail
