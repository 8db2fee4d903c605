// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "grid.hpp"
#include "orca/sim/mesh.hpp"

namespace orca::sim::detail {

// Meshes that stand still. A sensor sees their section at its height; sections are made when first needed and
// kept, since sensors have few heights.
class MeshSections {
 public:
  explicit MeshSections(std::vector<std::shared_ptr<const Mesh>> meshes) : meshes_(std::move(meshes)) {}

  // As Grid::cast(). From many threads.
  void cast(const Ray& ray, Hit& hit) const {
    if (!meshes_.empty()) at(ray.sensor_height)->cast(ray, hit);
  }

 private:
  [[nodiscard]] std::shared_ptr<const Grid> at(double height) const;

  std::vector<std::shared_ptr<const Mesh>> meshes_;
  mutable std::mutex mutex_;
  mutable std::map<double, std::shared_ptr<const Grid>> sections_;  // By height; guarded by mutex_.
};

}  // namespace orca::sim::detail
