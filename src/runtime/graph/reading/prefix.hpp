// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "node.hpp"

namespace orca::graph {

// Puts a context such as "left/" before the names that a part of a sub-graph has or refers to.
void put_prefix(Node& node, const std::string& context);

}  // namespace orca::graph
