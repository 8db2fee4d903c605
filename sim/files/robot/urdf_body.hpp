// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <urdf_parser/urdf_parser.h>
#include <map>
#include <string>

#include "orca/base/result.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/xml/document.hpp"
#include "urdf_check.hpp"

namespace orca::sim::detail {

// A joint with the links and parts that move with it.
struct UrdfJoint {
  Pose3 X_BJ;
  double upright = 0.0;            // z component of its unit axis.
  bool continuous = false;         // True if it turns without end.
  std::vector<std::string> links;  // All links below it.
  std::size_t first_part = 0;      // First of the body's parts below it; end_part is one after the last.
  std::size_t end_part = 0;
};

// The content of a URDF that the simulation uses, in the frame of the root link.
struct UrdfBody {
  std::string name;
  double mass = 0.0;
  double yaw_inertia = 0.0;
  std::vector<Part> parts;
  std::map<std::string, Pose3> links;
  std::map<std::string, UrdfJoint> joints;
};

// Reads a body from the text of a URDF and from its elements.
// @pre  check_urdf() found no error in `robot`, which was read from the text, and gave `hulls`.
// @errors  invalid_argument if urdfdom rejects the text; it does not say where.
[[nodiscard]] Result<UrdfBody> read_urdf_body(const xml::Element& robot, const std::string& text,
                                              const MeshHulls& hulls);

// Computes the rotations of all joints, collisions and inertias from their angles in the file. urdfdom computes them with the C
// library's sine and cosine, which differ from machine to machine.
// @pre  check_urdf() found no error in `robot`, and urdfdom read `model` from the same text.
void compute_rotations(const xml::Element& robot, urdf::ModelInterface& model);

}  // namespace orca::sim::detail
