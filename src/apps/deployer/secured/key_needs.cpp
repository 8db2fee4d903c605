// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "key_needs.hpp"

#include <filesystem>
#include <vector>

#include "orca/base/files/key_folder.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"

namespace orca::deployer {
namespace {

// Returns the processes on a machine that speak over DDS.
std::vector<std::string> speakers(const graph::Graph& graph, const std::string& machine) {
  std::vector<std::string> names;
  for (const graph::ProcessNode& process : graph::processes_on(graph, machine))
    if (graph::speaks_dds(graph, process.name)) names.push_back(process.name);
  if (graph::has_neighbours(graph)) names.emplace_back(kPeersKeys);
  return names;
}

std::string need_of(const graph::Graph& graph, const std::string& machine) {
  const std::vector<std::string> names = speakers(graph, machine);
  if (names.empty()) return "security: no process of this graph speaks over DDS, so it needs no keys\n";
  return "security: " + (machine.empty() ? "this machine" : "machine " + machine) + " needs keys of " +
         joined(names, ", ") + " in " + key_folder(graph.name, machine).value_or("a folder of its user") +
         "; orcactl keys makes them\n";
}

}  // namespace

std::string key_needs(const graph::Graph& graph) {
  if (!graph.secured) return {};
  if (graph.machines.empty()) return need_of(graph, {});
  std::string text;
  for (const graph::MachineNode& machine : graph.machines) text += need_of(graph, machine.name);
  return text;
}

Status check_keys(const graph::Graph& graph, const std::string& machine) {
  if (!graph.secured) return ok();
  const std::vector<std::string> names = speakers(graph, machine);
  if (names.empty()) return ok();
  const Result<std::string> folder = key_folder(graph.name, machine);
  if (!folder) return folder.error();
  for (const std::string& name : names) {
    const std::string file = *folder + "/" + key_file_name(name);
    std::error_code none;
    if (std::filesystem::exists(file, none)) continue;
    return fail(Code::not_found,
                "the graph says security=\"on\", and process " + name + " has no key: there is no " + file +
                    "; make keys with orcactl keys, and copy this machine's folder to " + *folder);
  }
  return ok();
}

}  // namespace orca::deployer
