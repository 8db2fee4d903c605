// SPDX-License-Identifier: LGPL-3.0-or-later
#include "odometry_model.hpp"

#include "orca/geometry/arc.hpp"

namespace orca::sim::detail {

void OdometryModel::add(const Travel2& real, double seconds) {
  const Travel2 believed = wheels_.measured(real, random_);
  pose_ = along_arc(pose_, believed);
  velocity_ = believed / seconds;
}

}  // namespace orca::sim::detail
