// SPDX-License-Identifier: LGPL-3.0-or-later
// A graph's parts as the attributes that they have in XML: what print() writes, diff() compares and the JSON
// form holds.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "orca/graph/graph.hpp"

namespace orca::graph {

using Attributes = std::vector<std::pair<std::string, std::string>>;

// Without the name, and without what has its default.
Attributes attributes_of(const Graph& graph);
Attributes attributes_of(const HardwareNode& node);
Attributes attributes_of(const ComponentNode& node);
Attributes attributes_of(const PortSetting& setting);
// Without the ends; the policy is complete.
Attributes attributes_of(const Edge& edge);

// As it stands in a <param>.
std::string value_text(const ParamValue& value);

}  // namespace orca::graph
