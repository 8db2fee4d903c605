// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <urdf_parser/urdf_parser.h>

#include "orca/xml/document.hpp"

namespace orca::robots::detail {

// Computes the rotations of all joints, collisions and inertias from their angles in the file. urdfdom computes them with the C
// library's sine and cosine, which differ from machine to machine.
// @pre  check_urdf() found no error in `robot`, and urdfdom read `model` from the same text.
void compute_rotations(const xml::Element& robot, urdf::ModelInterface& model);

}  // namespace orca::robots::detail
