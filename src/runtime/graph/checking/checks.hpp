// SPDX-License-Identifier: LGPL-3.0-or-later

// The checks of a graph whose parts are read, each in a file of its own. What is wrong they report.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "checking/model.hpp"
#include "checking/types.hpp"
#include "orca/graph/catalogue.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/process.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the changes in the order of their times. The graphs that they name are not read.
std::vector<PlannedChange> check_changes(const std::vector<Node>& nodes, Report& report);

// Returns the rules for restarts that the <graph> element gives.
Supervision read_supervision(const Node& root, Report& report);

void check_machines(const std::vector<Node>& nodes, Model& model, Report& report);
// Call it after check_machines().
void check_processes(const std::vector<Node>& nodes, Model& model, Report& report);

void check_hardware(const std::vector<Node>& nodes, Types& types, Model& model, Report& report);

// Reports drivers of lines `emulated:NAME` that no hardware of the graph offers: an error if some hardware emulates others, else a
// warning, for the emulation may be another system's.
// @param nodes  those of the model's hardware, in its order.
void check_emulated_lines(const std::vector<Node>& nodes, const Model& model, Report& report);
// Returns whether hardware emulates devices, so that drivers need it, whoever is bound to it.
bool offers_lines(const HardwareNode& hardware);

void check_components(const std::vector<Node>& nodes, Types& types, Model& model, Report& report);

// Puts components and hardware into their processes, and reports what cannot live together or apart.
// @param components  the nodes of model.components
void check_placement(const std::vector<Node>& components, Model& model, Report& report);

// Warns about processes and machines of a sound graph on which nothing runs.
void check_nothing_runs(const Model& model, Report& report);

// Returns the groups, in the order of the file. Call it after check_components().
std::vector<GroupNode> check_groups(const std::vector<Node>& nodes, const Model& model, Report& report);

// The connections of a graph.
struct WiredEdges {
  std::vector<Edge> edges;
  // Components that may lack a connection which the graph means to give them. What they say about their connections
  // may follow from an error that is reported already.
  std::set<std::string> doubtful;
};

WiredEdges check_wiring(const std::vector<Node>& connections, const Model& model, Report& report);

// Reports the edges that keep only the latest object although it must wait there for objects of other ports: those
// to the ports of a component whose laps start on objects of one moment.
void check_waiting_room(const Model& model, const std::vector<Edge>& edges, Report& report);

void check_start_order(const Model& model, Report& report);

// Reports what cannot be in a process that is started on demand, and connections that could not wake it.
// graph has its ends, its edges and its rules of supervision already.
void check_demand(const Model& model, const Graph& graph, Report& report);

// Warns about parts of a sound graph that can have no effect.
void check_influence(const Model& model, const Graph& graph, Report& report);

// A graph with its connections, and what is known about its faults so far.
struct Configuration {
  const std::vector<Node>& nodes;  // of model.components
  const Model& model;
  const Graph& graph;                     // without components and hardware
  const std::set<std::string>& doubtful;  // see WiredEdges
};

// Calls configure() of the components as a trial and reports what they refuse. Components with an error of their own
// are left out.
void check_configuration(const Configuration& configuration, Catalogue& catalogue, Report& report);

}  // namespace orca::graph
