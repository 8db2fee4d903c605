// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "orca/base/result.hpp"
#include "orca/sim/robot_model.hpp"
#include "urdf_check.hpp"

namespace orca::sim::detail {

// What of a URDF the simulation uses; everything in the frame of the root link.
struct UrdfBody {
  std::string name;
  double mass = 0.0;
  double yaw_inertia = 0.0;
  std::vector<Part> parts;
  std::map<std::string, Pose3> links;
};

// @pre  check_urdf() found the text sound and gave `hulls`.
// @errors  invalid_argument if urdfdom does not take the text, without saying where.
[[nodiscard]] Result<UrdfBody> read_urdf_body(const std::string& text, const MeshHulls& hulls);

}  // namespace orca::sim::detail
