// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Reads what the <graph> element says of the team that the system joins.
Team read_team(const Node& root, Report& report);

// Returns what is wrong with a port that is to speak to the team by that name, for people; empty if nothing is.
std::string team_fault(std::string_view name, const PortContract& port);

// Returns what ports offer to the team and hear from it, by name. Reports names that have two types, and a team of a graph that asks for
// security: what is said there is plain.
std::vector<TeamPort> check_team(const Graph& graph, const xml::Position& join, const Model& model,
                                 Report& report);

}  // namespace orca::graph
