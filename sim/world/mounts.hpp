// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "orca/sim/robot_model.hpp"
#include "orca/xml/document.hpp"

namespace orca::sim::detail {

// Tells the model's sensors where they are: at the poses `links` of their links in the base frame. R012 at
// each element of `orca` whose attribute `link` names none.
void mount_sensors(RobotModel& model, const std::map<std::string, Pose3>& links, const xml::Element& orca,
                   xml::Diagnostics& diagnostics);

}  // namespace orca::sim::detail
