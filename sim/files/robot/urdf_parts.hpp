// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/robot_file/codes.hpp"
#include "orca/robot_file/reader.hpp"
#include "orca/robot_file/rules.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::sim::detail {

namespace robot_codes = robot_file::codes;
using robot_file::kJointType;
using robot_file::kRobotFile;
using robot_file::only_child;

// Checks names, parents, roots, loops and mimics.
void check_tree(const xml::Element& robot, xml::Reporter& reporter);

}  // namespace orca::sim::detail
