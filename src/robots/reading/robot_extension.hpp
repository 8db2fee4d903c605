// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/robots/characteristics.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::robots::detail {

// Reads the <orca> element of a robot into `model`. Ring centres are left for later, because they need the
// links' poses.
void read_extension(const xml::Element& orca, Characteristics& model, xml::Reporter& reporter);

}  // namespace orca::robots::detail
