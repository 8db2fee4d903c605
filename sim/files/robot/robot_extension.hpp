// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "files/formats/attributes.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// Reads the <orca> element of a robot into `model`; ring centres are left for later, they need the links'
// poses.
void read_extension(const xml::Element& orca, RobotModel& model, xml::Diagnostics& diagnostics);

}  // namespace orca::sim::detail
