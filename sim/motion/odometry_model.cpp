// SPDX-License-Identifier: LGPL-3.0-or-later
#include "odometry_model.hpp"

namespace orca::sim::detail {

void OdometryModel::add(const Travel& real, double seconds) {
  const Travel believed = wheels_.measured(real, random_);
  pose_ = along_arc(pose_, believed);
  velocity_ = {believed.forward / seconds, believed.turn / seconds, believed.left / seconds};
}

}  // namespace orca::sim::detail
