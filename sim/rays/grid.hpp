// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "cone.hpp"
#include "elements.hpp"
#include "orca/base/mutex.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/mesh.hpp"
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

// The meshes that never move. A sensor sees their section at its height. Sections are made when first needed
// and then kept, because sensors have few different heights.
class MeshSections {
 public:
  explicit MeshSections(std::vector<std::shared_ptr<const Mesh>> meshes) : meshes_(std::move(meshes)) {}

  // Replaces the hit by the nearest edge on the ray if that is closer. Many threads may call it at once.
  void cast(const Ray& ray, Hit& hit) const {
    if (!meshes_.empty()) at(ray.sensor_height)->cast(ray, hit);
  }

  // Adds to the view of a cone all edges that can be seen in it. They all have the same number.
  void show(const Cone& cone, double height, std::uint64_t number, Panorama& view) const {
    if (!meshes_.empty()) at(height)->show(cone, number, 0, view);
  }

 private:
  [[nodiscard]] std::shared_ptr<const Grid> at(double height) const;

  std::vector<std::shared_ptr<const Mesh>> meshes_;
  mutable Mutex mutex_;
  mutable std::map<double, std::shared_ptr<const Grid>> sections_ ORCA_GUARDED_BY(mutex_);  // by height
};

}  // namespace orca::sim::detail
