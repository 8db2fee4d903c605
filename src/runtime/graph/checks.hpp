// SPDX-License-Identifier: LGPL-3.0-or-later
// The phases of checking a graph's content. Each goes through everything it can still judge, and says nothing
// about what an earlier phase has reported.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "model.hpp"
#include "node.hpp"
#include "orca/graph/loader.hpp"
#include "report.hpp"

namespace orca::graph {

// Asks the catalogue about types and tells what it answers, a broken plugin only once.
class Types {
 public:
  Types(Catalogue& catalogue, Report& report) : catalogue_(catalogue), report_(report) {}

  // The contract of the node's type; nothing if it has none, after a report.
  std::optional<Contract> hardware(const Node& node);
  std::optional<Contract> component(const Node& node, const HardwareUse* use);
  // The same without a report about the plugin: the hardware that it would need is not to be had.
  std::optional<Contract> component_without_hardware(const Node& node);
  [[nodiscard]] Catalogue& catalogue() { return catalogue_; }

 private:
  // The type's name, or null after a report.
  const Text* type_of(const Node& node);
  void report_failure(const Node& node, const Error& error, PluginKind kind);
  // What keeps the type out of this run, once per type.
  void report_unfit(const Node& node, const std::string& type, PluginKind kind);

  Catalogue& catalogue_;
  Report& report_;
  std::set<std::string> broken_;
  std::set<std::string> unfit_;
};

// Reports a bad name of the node. Names that are missing or unknown are reported already.
void check_name(const Node& node, const char* attribute, Report& report);

// Reports that `name`, said at `place`, is no component, unless that is excused. True if it is one.
bool check_component_exists(const std::string& name, const xml::Position& place, const std::string& title,
                            const Model& model, Report& report);

void check_hardware(const std::vector<Node>& nodes, Types& types, Model& model, Report& report);
void check_components(const std::vector<Node>& nodes, Types& types, Model& model, Report& report);
void check_start_order(const Model& model, Report& report);
// Warns about parts of a sound graph that can have no effect.
void check_influence(const Model& model, const Graph& graph, Report& report);
std::vector<Edge> check_wiring(const std::vector<Node>& connections, const Model& model, Report& report);

}  // namespace orca::graph
