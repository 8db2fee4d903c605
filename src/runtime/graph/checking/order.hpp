// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "model.hpp"
#include "reading/report.hpp"

namespace orca::graph {

void check_start_order(const Model& model, Report& report);

}  // namespace orca::graph
