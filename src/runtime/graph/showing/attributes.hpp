// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of a graph as attributes, as in XML. print() writes them, diff() compares them, and the JSON form
// holds them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "orca/graph/graph.hpp"

namespace orca::graph {

// How diff() calls a planned change, before its time.
inline constexpr const char* kChangeField = "change at ";

using Attributes = std::vector<std::pair<std::string, std::string>>;

// Return the attributes of a part, without its name and without values equal to the default.
Attributes attributes_of(const Graph& graph);
Attributes attributes_of(const MachineNode& node);
Attributes attributes_of(const ProcessNode& node);
Attributes attributes_of(const HardwareNode& node);
Attributes attributes_of(const ComponentNode& node);
Attributes attributes_of(const PortSetting& setting);
Attributes attributes_of(const GroupNode& node);
// The time comes first.
Attributes attributes_of(const PlannedChange& change);
// Returns the attributes without the ends; the policy is complete.
Attributes attributes_of(const Edge& edge);

// Returns the value as it is written in a <param>.
std::string value_text(const ParamValue& value);

}  // namespace orca::graph
