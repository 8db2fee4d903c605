// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "orca/graph/catalogue.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// The types of a graph as the catalogue knows them. It reports the catalogue's errors, each broken plugin
// only once.
class Types {
 public:
  Types(Catalogue& catalogue, Report& report) : catalogue_(catalogue), report_(report) {}

  // Returns the contract of the node's type; nothing if it has none, after a report.
  std::optional<Contract> hardware(const Node& node);
  // Does the same; null if it has none. Components of one type without hardware share it.
  std::shared_ptr<const Contract> component(const Node& node, const HardwareUse* use);
  // Returns the same without a report about the plugin, for a component whose hardware is not available.
  std::shared_ptr<const Contract> component_without_hardware(const Node& node);
  [[nodiscard]] Catalogue& catalogue() { return catalogue_; }

 private:
  // Returns the type's name, or null after a report.
  const Text* type_of(const Node& node);
  // Asks the catalogue, once for all components of a type without hardware.
  Result<std::shared_ptr<const Contract>> ask(const std::string& type, const HardwareUse* use);
  void report_failure(const Node& node, const Error& error, PluginKind kind);
  // Reports what keeps the type out of this run, once per type.
  void report_unfit(const Node& node, const std::string& type, PluginKind kind);

  Catalogue& catalogue_;
  Report& report_;
  std::map<std::string, std::shared_ptr<const Contract>> without_hardware_;  // by type
  std::set<std::string> broken_;
  std::set<std::string> unfit_;
};

}  // namespace orca::graph
