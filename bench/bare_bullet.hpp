// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "orca/sim/caster.hpp"

namespace orca::bench {

/// A range sensor with Bullet's own rays, to measure their cost. All obstacles are one static triangle mesh
/// in a separate world: the fastest way that Bullet has, and the only reliable one.
class BulletMesh {
 public:
  /// @pre  all obstacles are boxes.
  explicit BulletMesh(const sim::WorldModel& world);
  ~BulletMesh();
  /// Returns the distance to the first triangle on the ray [m], or the ray's maximum range.
  [[nodiscard]] double cast(const sim::Ray& ray) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace orca::bench
