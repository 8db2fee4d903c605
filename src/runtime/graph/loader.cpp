// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/loader.hpp"

#include "checks.hpp"
#include "naming.hpp"
#include "orca/xml/document.hpp"
#include "profiles.hpp"
#include "structure.hpp"
#include "values.hpp"

namespace orca::graph {
namespace {

std::vector<std::string> plugin_folders(const Node& graph) {
  const Text* plugins = graph.known("plugins");
  if (plugins == nullptr) return {};
  std::vector<std::string> folders = split_list(plugins->value);
  std::erase(folders, "");
  for (std::string& folder : folders) folder = resolved_path(folder, *plugins);
  return folders;
}

std::optional<std::uint64_t> read_seed(const Node& graph, Report& report) {
  const Text* seed = graph.find("seed");
  if (seed == nullptr) return std::nullopt;
  ParamContract contract;
  contract.type = ParamType::integer;
  contract.min = 0;
  const auto value = read_value(*seed, contract, "seed", report);
  if (!value) return std::nullopt;
  return static_cast<std::uint64_t>(std::get<std::int64_t>(*value));
}

std::vector<std::string> read_ends(const Node& graph, const Model& model, Report& report) {
  const std::vector<std::string> ends = split_names(graph.value("ends"));
  for (const std::string& name : ends)
    check_component_exists(name, graph.place("ends"), "ends", model, report);
  return ends;
}

// What the <graph> element itself says, but for its ends, which are names of components.
Graph read_root(const Node& root, Report& report) {
  Graph graph;
  check_name(root, "name", report);
  graph.name = root.value("name");
  graph.default_profile = root.value("default_profile");
  graph.plugin_dirs = plugin_folders(root);
  graph.seed = read_seed(root, report);
  return graph;
}

Graph check(const Structure& structure, const LoadOptions& options, Catalogue& catalogue, Report& report) {
  const Node& root = structure.graph;
  Graph graph = read_root(root, report);
  catalogue.add_folders(graph.plugin_dirs);
  const Parts parts = merge_profiles(root, options.profiles, report);
  Types types(catalogue, report);
  Model model;
  model.excused = structure.excused;
  model.names_incomplete = structure.names_incomplete;
  check_hardware(parts.hardware, types, model, report);
  check_components(parts.components, types, model, report);
  check_start_order(model, report);
  graph.ends = read_ends(root, model, report);
  graph.edges = check_wiring(parts.connections, model, report);
  for (CheckedHardware& hardware : model.hardware) graph.hardware.push_back(std::move(hardware.value));
  for (CheckedComponent& component : model.components) graph.components.push_back(std::move(component.value));
  return graph;
}

std::optional<Graph> load(const std::optional<xml::Document>& document, const LoadOptions& options,
                          Catalogue& catalogue, xml::Diagnostics& diagnostics) {
  if (!document) return std::nullopt;
  Report report(diagnostics);
  Arguments arguments(options.settings, report);
  const auto structure = read_structure(*document, arguments, report);
  if (!structure) return std::nullopt;
  Graph graph = check(*structure, options, catalogue, report);
  return diagnostics.has_errors() ? std::nullopt : std::optional(std::move(graph));
}

}  // namespace

std::optional<Graph> load_file(const std::string& path, const LoadOptions& options, Catalogue& catalogue,
                               xml::Diagnostics& diagnostics) {
  return load(xml::read_file(path, diagnostics), options, catalogue, diagnostics);
}

std::optional<Graph> load_text(std::string_view text, const std::string& file_name,
                               const LoadOptions& options, Catalogue& catalogue,
                               xml::Diagnostics& diagnostics) {
  return load(xml::read_text(text, file_name, diagnostics), options, catalogue, diagnostics);
}

}  // namespace orca::graph
