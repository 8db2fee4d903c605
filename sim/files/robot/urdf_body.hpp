// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "orca/base/result.hpp"
#include "orca/sim/robot_model.hpp"
#include "urdf_check.hpp"

namespace orca::sim::detail {

// A joint and what moves with it.
struct UrdfJoint {
  Pose3 X_BJ;
  double upright = 0.0;            // z component of its unit axis.
  bool continuous = false;         // It turns without end.
  std::vector<std::string> links;  // All below it.
  std::size_t first_part = 0;      // Of the body's parts, the ones below it: up to, not with, end_part.
  std::size_t end_part = 0;
};

// What of a URDF the simulation uses; everything in the frame of the root link.
struct UrdfBody {
  std::string name;
  double mass = 0.0;
  double yaw_inertia = 0.0;
  std::vector<Part> parts;
  std::map<std::string, Pose3> links;
  std::map<std::string, UrdfJoint> joints;
};

// @pre  check_urdf() found the text sound and gave `hulls`.
// @errors  invalid_argument if urdfdom does not take the text, without saying where.
[[nodiscard]] Result<UrdfBody> read_urdf_body(const std::string& text, const MeshHulls& hulls);

}  // namespace orca::sim::detail
