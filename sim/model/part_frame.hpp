// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>

#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// The frame of a part, for points in the base frame.
class PartFrame {
 public:
  explicit PartFrame(const Pose3& X_BP) : origin_{X_BP.x, X_BP.y, X_BP.z} {
    const double x = X_BP.qx, y = X_BP.qy, z = X_BP.qz, w = X_BP.qw;
    axes_ = {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
             Vec3{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
             Vec3{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  }

  // Returns the part's axis number `i` in the base frame, a unit vector.
  [[nodiscard]] const Vec3& axis(std::size_t i) const { return axes_[i]; }

  // Returns in the base frame a point that is given in the part's frame.
  [[nodiscard]] Vec3 in_base(const Vec3& p) const {
    return {origin_.x + axes_[0].x * p.x + axes_[1].x * p.y + axes_[2].x * p.z,
            origin_.y + axes_[0].y * p.x + axes_[1].y * p.y + axes_[2].y * p.z,
            origin_.z + axes_[0].z * p.x + axes_[1].z * p.y + axes_[2].z * p.z};
  }

 private:
  Vec3 origin_;
  std::array<Vec3, 3> axes_;
};

}  // namespace orca::sim::detail
