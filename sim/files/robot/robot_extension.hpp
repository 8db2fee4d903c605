// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/sim/robot_model.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::sim::detail {

// Reads the <orca> element of a robot into `model`. Ring centres are left for later, because they need the
// links' poses.
void read_extension(const xml::Element& orca, RobotModel& model, xml::Reporter& reporter);

}  // namespace orca::sim::detail
