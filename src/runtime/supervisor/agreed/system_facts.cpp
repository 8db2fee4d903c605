// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/system_facts.hpp"

#include <optional>
#include <utility>

namespace orca::supervisor {
namespace {

PluginFacts plugin_of(PluginKind kind, const std::string& type, host::PluginCatalogue& catalogue) {
  Result<host::LoadedType> loaded = catalogue.acquire(kind, type);
  if (!loaded) return {};
  PluginFacts facts{loaded->file(), loaded->library ? loaded->library->build_id() : ""};
  (void)catalogue.release(std::move(loaded).value());  // the catalogue itself keeps it
  return facts;
}

}  // namespace

SystemFacts facts_of(const graph::Graph& graph, host::PluginCatalogue& catalogue) {
  SystemFacts facts;
  facts.plugin_folders = catalogue.folders();
  facts.ports = graph::list_ports(graph, catalogue);
  for (const graph::HardwareNode& node : graph.hardware) {
    facts.plugins[node.type] = plugin_of(PluginKind::hardware, node.type, catalogue);
    if (Result<Contract> contract = catalogue.hardware(node.type))
      facts.drivers[node.name] = std::move(contract).value();
  }
  for (const graph::ComponentNode& node : graph.components) {
    facts.plugins[node.type] = plugin_of(PluginKind::component, node.type, catalogue);
    std::optional<graph::HardwareUse> use;
    if (const graph::HardwareNode* const hardware = graph.find_hardware(node.hardware))
      use = {hardware->name, hardware->type, hardware->params};
    if (Result<Contract> contract = catalogue.component(node.type, use ? &*use : nullptr))
      facts.contracts[node.name] = std::move(contract).value();
  }
  return facts;
}

std::map<std::string, std::string> builds_in(const graph::Graph& graph, const std::string& process,
                                             host::PluginCatalogue& catalogue) {
  std::map<std::string, std::string> builds;
  for (const graph::HardwareNode& node : graph.hardware)
    if (node.process == process)
      builds[node.type] = plugin_of(PluginKind::hardware, node.type, catalogue).build_id;
  for (const graph::ComponentNode& node : graph.components)
    if (node.process == process && !node.on_demand)
      builds[node.type] = plugin_of(PluginKind::component, node.type, catalogue).build_id;
  return builds;
}

}  // namespace orca::supervisor
