// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "orca/sim/caster.hpp"

namespace orca::bench {

/// What a range sensor costs with Bullet's own rays: all obstacles as one static triangle mesh in a world of
/// its own, which is its fastest and its only sound way.
class BulletMesh {
 public:
  /// @pre  all obstacles are boxes.
  explicit BulletMesh(const sim::WorldModel& world);
  ~BulletMesh();
  /// The distance to the first triangle on the ray [m], or its maximum range.
  [[nodiscard]] double cast(const sim::Ray& ray) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace orca::bench
