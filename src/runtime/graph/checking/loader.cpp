// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/loader.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "checking/checks.hpp"
#include "endpoints.hpp"
#include "model.hpp"
#include "orca/xml/document.hpp"
#include "ports.hpp"
#include "reading/assembly.hpp"
#include "reading/codes.hpp"
#include "reading/command_line.hpp"
#include "reading/merging/parameter_settings.hpp"
#include "reading/merging/profiles.hpp"
#include "reading/naming.hpp"
#include "reading/values.hpp"
#include "team.hpp"
#include "types.hpp"

namespace orca::graph {
namespace {

std::vector<std::string> read_ends(const Node& graph, const Model& model, Report& report) {
  const std::vector<std::string> ends = split_names(graph.value("ends"));
  for (const std::string& name : ends)
    check_component_exists(name, graph.place("ends"), "ends", model, report);
  return ends;
}

// Reads the <graph> element's own attributes, except its ends, which are names of components.
Graph read_root(const Node& root, const LoadOptions& options, Report& report) {
  Graph graph;
  graph.name = options.name.empty() ? root.value("name") : options.name;
  if (const auto fault = options.name.empty() ? std::nullopt : name_fault(options.name))
    report.error(codes::kBadName, command_line(), shown_option("--name", options.name) + ": " + *fault);
  const auto domain = read_attribute<std::int64_t>(root, "domain", report);
  graph.domain = options.domain.value_or(static_cast<std::uint32_t>(domain.value_or(0)));
  graph.team = read_team(root, report);
  graph.default_profile = root.value("default_profile");
  graph.supervision = read_supervision(root, report);
  graph.records_always = read_attribute<std::string>(root, "record", report) == "always";
  if (const auto bytes = read_attribute<double>(root, "record_space", report))
    graph.record_space = static_cast<std::uint64_t>(std::llround(*bytes));
  graph.secured = read_attribute<std::string>(root, "security", report) == "on";
  return graph;
}

// Adds the candidates of late-bound edges to their ports, so that print() can write them.
void note_candidates(Model& model, const std::vector<Edge>& edges) {
  for (const Edge& edge : edges) {
    if (!edge.late_bound) continue;
    auto& ports = model.components[model.component_by_name.at(edge.to.component)].value.ports;
    const auto is_it = [&](const auto& port) { return port.second.alias == edge.to.port; };
    const auto renamed = std::ranges::find_if(ports, is_it);
    PortSetting& setting = renamed == ports.end() ? ports[edge.to.port] : renamed->second;
    setting.candidates.push_back(edge.from);
  }
}

void announce_types(const Parts& parts, Catalogue& catalogue) {
  std::vector<std::string> types;
  for (const auto& nodes : {std::cref(parts.hardware), std::cref(parts.components)})
    for (const Node& node : nodes.get()) types.push_back(node.value("type"));
  catalogue.expect(types);
}

// Checks everything but the connections.
Model check_parts(const Assembly& assembly, const Parts& parts, Catalogue& catalogue, Report& report) {
  Types types(catalogue, report);
  Model model;
  model.excused = assembly.excused;
  model.names_incomplete = assembly.names_incomplete;
  model.parts_missing = parts.some_missing;
  model.left_out = parts.left_out;
  check_machines(parts.machines, model, report);
  check_processes(parts.processes, model, report);
  announce_types(parts, catalogue);
  check_hardware(parts.hardware, types, model, report);
  check_components(parts.components, types, model, report);
  check_topics(model, catalogue, report);
  check_placement(parts.components, model, report);
  check_start_order(model, report);
  return model;
}

void take_parts(Model&& model, Graph& graph) {
  graph.machines = std::move(model.machines);
  for (CheckedProcess& process : model.processes) graph.processes.push_back(std::move(process.value));
  for (CheckedHardware& hardware : model.hardware) graph.hardware.push_back(std::move(hardware.value));
  for (CheckedComponent& component : model.components) graph.components.push_back(std::move(component.value));
}

Graph check(Assembly assembly, const LoadOptions& options, Catalogue& catalogue, Report& report) {
  const Node& root = assembly.graph;
  Graph graph = read_root(root, options, report);
  graph.plugin_dirs = assembly.plugin_folders;
  catalogue.add_folders(graph.plugin_dirs);
  Parts parts = merge_profiles(assembly, options.profiles, report);
  set_parameters(assembly, parts, report);
  assembly.graph.children.clear();  // the parts are copies
  Model model = check_parts(assembly, parts, catalogue, report);
  check_security(graph, model, report);
  graph.team.ports = check_team(graph, root.place("join"), model, report);
  model.any_link = options.any_link;
  graph.ends = read_ends(root, model, report);
  for (const std::string& name : options.failing)
    check_component_exists(name, command_line(), shown_option("--fail", name), model, report);
  for (const std::string& name : options.recorded) check_recorded_port(name, model, report);
  graph.groups = check_groups(parts.groups, model, report);
  graph.changes = check_changes(parts.changes, report);
  if (options.changes != nullptr) *options.changes = graph.changes;
  WiredEdges wired = check_wiring(parts.connections, model, report);
  graph.edges = std::move(wired.edges);
  check_waiting_room(model, graph.edges, report);
  check_demand(model, graph, report);
  note_candidates(model, graph.edges);
  if (report.no_errors()) {
    check_influence(model, graph, report);
    check_nothing_runs(model, report);
  }
  if (options.try_components)
    check_configuration({parts.components, model, graph, wired.doubtful}, catalogue, report);
  take_parts(std::move(model), graph);
  return graph;
}

bool is_expanded(const xml::Document& document) {
  const xml::Attribute* const expanded = document.root.attribute("expanded");
  return expanded != nullptr && expanded->value == "true";
}

std::optional<Graph> load(std::optional<xml::Document> document, LoadOptions options, Catalogue& catalogue,
                          xml::Diagnostics& diagnostics, const FileReader& read) {
  if (!document) return std::nullopt;
  if (options.of_run && is_expanded(*document)) {
    options.profiles.clear();
    options.settings.clear();
  }
  Report report(diagnostics, options.strict);
  std::optional<Assembly> assembly = assemble(*document, options, read, report, diagnostics);
  if (!assembly) return std::nullopt;
  document.reset();  // of a large graph it is a large part of the memory
  Graph graph = check(std::move(*assembly), options, catalogue, report);
  return diagnostics.has_errors() ? std::nullopt : std::optional(std::move(graph));
}

}  // namespace

std::optional<Graph> load_file(const std::string& path, const LoadOptions& options, Catalogue& catalogue,
                               xml::Diagnostics& diagnostics) {
  return load(xml::read_file(path, diagnostics), options, catalogue, diagnostics, xml::read_bytes);
}

std::optional<Graph> load_text(std::string_view text, const std::string& file_name,
                               const LoadOptions& options, Catalogue& catalogue,
                               xml::Diagnostics& diagnostics, const FileReader& read) {
  return load(xml::read_text(text, file_name, diagnostics), options, catalogue, diagnostics, read);
}

}  // namespace orca::graph
