// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "profiles.hpp"
#include "reading/assembly.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Puts the parameters that the command line sets into their components and hardware, over those of the graph and its
// profiles. They are checked like those: a parameter's name and value are not looked at here.
void set_parameters(const Assembly& assembly, Parts& parts, Report& report);

}  // namespace orca::graph
