// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orca/robot_file/devices.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::robot_file {

/// Reads the element `<orca>` of a robot's file. Places on the robot are left, since they need the poses of its links.
/// @param robot     the root of the file, a URDF.
/// @param reporter  gets all that is wrong with the element, links that are not there among it.
/// @return the element; null if there is none, which is reported, too.
const xml::Element* read_devices(const xml::Element& robot, Devices& devices, xml::Reporter& reporter);

/// Returns what read_devices() has taken because an `<orca>` does not say it, for people; empty if nothing is missing.
[[nodiscard]] std::string usual_figures_text(const xml::Element& orca);

/// Returns the first child of that name, or null.
[[nodiscard]] const xml::Element* only_child(const xml::Element& element, std::string_view name);

}  // namespace orca::robot_file
