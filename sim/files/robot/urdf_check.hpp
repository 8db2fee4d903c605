// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/robot_file/codes.hpp"
#include "orca/robot_file/reader.hpp"
#include "orca/robot_file/rules.hpp"
#include "orca/sim/mesh.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::sim::detail {

// The corners of the convex hulls of the mesh files that are named as collision geometry, by that name, not
// scaled.
using MeshHulls = std::map<std::string, std::vector<Vec3>>;

// Reports the errors in the links and joints of a <robot>, with line and column; urdfdom, which reads the
// file afterwards, does not report places. Reads the meshes of collision geometry into `hulls`; `packages` is the folder of
// packages that mesh_path() takes.
void check_urdf(const xml::Element& robot, const std::string& packages, xml::Reporter& reporter,
                MeshHulls& hulls);

// Reports a file that is still in the language xacro, once, and returns whether it is one.
bool report_xacro(const xml::Element& robot, xml::Reporter& reporter);

namespace robot_codes = robot_file::codes;
using robot_file::kJointType;
using robot_file::kRobotFile;
using robot_file::only_child;

// Checks names, parents, roots, loops and mimics.
void check_tree(const xml::Element& robot, xml::Reporter& reporter);

}  // namespace orca::sim::detail
