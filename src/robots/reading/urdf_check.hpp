// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/robots/robot_file.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::robots::detail {

// The corners of the convex hulls of the mesh files that are named as collision geometry, by that name, not
// scaled.
using MeshHulls = std::map<std::string, std::vector<Vec3>>;

// Reports the errors in the links and joints of a <robot>, with line and column; urdfdom, which reads the
// file afterwards, does not report places. Has the meshes of collision geometry, beside the file, read into
// `hulls`; without a reader they have no corners.
void check_urdf(const xml::Element& robot, xml::Reporter& reporter, BodyReader* body, MeshHulls& hulls);

}  // namespace orca::robots::detail
