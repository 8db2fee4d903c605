// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/sim/robot_model.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"
#include "urdf_body.hpp"

namespace orca::sim::detail {

// Gives the model's turret, gripper and sensors their places on the body, those with a wrong name excepted. Reports a
// turret whose joint is not fit for one, a gripper inside the body or on the turret, and links that are tilted.
// @pre  the model has its footprint.
void mount_devices(RobotModel& model, const UrdfBody& body, const xml::Element& orca,
                   xml::Reporter& reporter);

}  // namespace orca::sim::detail
