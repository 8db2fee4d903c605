// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "model.hpp"
#include "orca/graph/catalogue.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Reads the <port>s of a component and changes its contract accordingly: new names, ports left out, ports with a topic that need no
// connection any more.
void read_ports(const Node& node, CheckedComponent& component, const Catalogue& catalogue, Report& report);

// Reports topics that have one message at one port and another one at another: they would never meet.
void check_topics(const Model& model, const Catalogue& catalogue, Report& report);

// Reports ports with a topic of ROS 2 in a graph that asks for security: what they say is plain.
void check_security(const Graph& graph, const Model& model, Report& report);

// Returns the ports of a contract for people: "in: laser, sonar; out: motion".
std::string ports_of(const Contract& contract);

}  // namespace orca::graph
