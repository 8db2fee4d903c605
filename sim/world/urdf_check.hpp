// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/xml/document.hpp"

namespace orca::sim::detail {

// Reports what is wrong with the links and joints of a <robot>, with line and column; urdfdom, which reads
// the file afterwards, cannot tell where a mistake is.
void check_urdf(const xml::Element& robot, xml::Diagnostics& diagnostics);

}  // namespace orca::sim::detail
