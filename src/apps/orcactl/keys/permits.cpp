// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "keys/permits.hpp"

#include <string>

#include "orca/base/files/key_folder.hpp"
#include "orca/graph/placement.hpp"
#include "orca/patterns/dds/topic_names.hpp"

namespace orca::orcactl {
namespace {

const std::string& process_of(const graph::Graph& graph, const graph::PortRef& port) {
  return graph.find_component(port.component)->process;
}

keys::Permit permit_of(const graph::Graph& graph, const graph::ProcessNode& process) {
  keys::Permit permit{process.machine, process.name, {}, {}};
  for (const graph::Edge& edge : graph.edges) {
    const std::string& from = process_of(graph, edge.from);
    const std::string& to = process_of(graph, edge.to);
    if (edge.link != graph::Link::dds || (from != process.name && to != process.name)) continue;
    const bool sends = from == process.name;
    permit.reads.insert(inbox_topic(graph.name, "*", process.name));
    permit.writes.insert(inbox_topic(graph.name, "*", sends ? to : from));
    if (edge.pattern == Pattern::push)
      (sends ? permit.writes : permit.reads).insert(object_topic(graph.name, edge.from.text()));
  }
  return permit;
}

}  // namespace

std::vector<keys::Permit> permits_of(const graph::Graph& graph) {
  std::vector<keys::Permit> permits;
  for (const graph::ProcessNode& process : graph::processes_of(graph))
    if (graph::speaks_dds(graph, process.name)) permits.push_back(permit_of(graph, process));
  if (!graph::has_neighbours(graph)) return permits;
  const std::string topic = "orca/" + graph.name + "/machines";
  for (const graph::MachineNode& machine : graph.machines)
    permits.push_back({machine.name, kPeersKeys, {topic}, {topic}});
  return permits;
}

}  // namespace orca::orcactl
