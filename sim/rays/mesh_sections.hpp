// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "grid.hpp"
#include "orca/base/mutex.hpp"
#include "orca/sim/mesh.hpp"

namespace orca::sim::detail {

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
