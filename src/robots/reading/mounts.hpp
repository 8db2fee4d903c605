// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/robots/robot_file.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"
#include "urdf_body.hpp"

namespace orca::robots::detail {

// Reports each element of `orca` that names a link or joint which is not in `robot`.
void check_mounts(const xml::Element& robot, const xml::Element& orca, xml::Reporter& reporter);

// Gives the robot's turret and sensors their places on the body, those with a wrong name excepted. Reports a
// turret whose joint is not fit for one, and links that are tilted.
// @param body_reader  checks what turns with the turret; may be null.
void mount_devices(Characteristics& robot, const UrdfBody& body, const xml::Element& orca,
                   BodyReader* body_reader, xml::Reporter& reporter);

}  // namespace orca::robots::detail
