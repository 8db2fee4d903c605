// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>

#include "orca/graph/catalogue.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

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

}  // namespace orca::graph
