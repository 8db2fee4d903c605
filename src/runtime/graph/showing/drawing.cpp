// SPDX-License-Identifier: LGPL-3.0-or-later
#include "drawing.hpp"

#include "attributes.hpp"

namespace orca::graph {
namespace {

std::string context_of(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? "" : name.substr(0, slash);
}

std::string last_of(const std::string& name) { return name.substr(name.rfind('/') + 1); }

// Returns the label of an edge. Objects flow from a PushServer or a SendProxy; a Query goes to its server and
// comes back.
std::string label_of(const Edge& edge) {
  std::string label = edge.from.port + " > " + edge.to.port;
  if (edge.pattern == Pattern::push && edge.queue.depth > 1)
    label += " (" + std::to_string(edge.queue.depth) + ")";
  if (edge.pattern == Pattern::send) label += " (send)";
  if (edge.pattern == Pattern::query) label += " (query)";
  if (edge.late_bound) label += " (candidate)";
  return label;
}

}  // namespace

Drawing drawing_of(const Graph& graph, const std::string& profiles) {
  Drawing drawing;
  drawing.title = graph.name + (profiles.empty() ? "" : ", profile " + profiles);
  std::map<std::string, std::string> ids;
  std::map<std::string, std::string> hardware_ids;
  for (const HardwareNode& node : graph.hardware) {
    const std::string id = "h" + std::to_string(hardware_ids.size());
    hardware_ids[node.name] = id;
    drawing.nodes[context_of(node.name)].push_back({id, last_of(node.name), node.type, true});
  }
  for (const ComponentNode& node : graph.components) {
    const std::string id = "c" + std::to_string(ids.size());
    ids[node.name] = id;
    drawing.nodes[context_of(node.name)].push_back({id, last_of(node.name), node.type, false});
    if (!node.hardware.empty()) drawing.edges.push_back({hardware_ids[node.hardware], id, "hardware", false});
  }
  for (const Edge& edge : graph.edges)
    drawing.edges.push_back(
        {ids[edge.from.component], ids[edge.to.component], label_of(edge), edge.late_bound});
  return drawing;
}

}  // namespace orca::graph
