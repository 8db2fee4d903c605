// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/sim/robot_model.hpp"
#include "orca/xml/document.hpp"
#include "urdf_body.hpp"

namespace orca::sim::detail {

// Tells the model's turret and sensors where on the body they are. R012 at each element of `orca` that names
// a link or joint which is not there, R022 at a turret whose joint is not fit for one.
void mount_devices(RobotModel& model, const UrdfBody& body, const xml::Element& orca,
                   xml::Diagnostics& diagnostics);

}  // namespace orca::sim::detail
