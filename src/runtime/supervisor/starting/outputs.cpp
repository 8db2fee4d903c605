// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/outputs.hpp"

#include <set>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"

namespace orca::supervisor {
namespace {

constexpr const char* kOtherwise = "; add --in-process or --clock virtual";

std::string listed_names(const std::set<std::string>& names) {
  return listed(std::vector<std::string>(names.begin(), names.end()));
}

std::set<std::string> processes_of_ports(const graph::Graph& graph, const host::RecordingOptions& recording) {
  std::set<std::string> processes;
  for (const std::string& port : recording.ports) {
    const graph::ComponentNode* const component = graph.find_component(port.substr(0, port.rfind('.')));
    if (component != nullptr) processes.insert(component->process);
  }
  return processes;
}

std::set<std::string> processes_of_hardware(const graph::Graph& graph) {
  std::set<std::string> processes;
  for (const graph::HardwareNode& node : graph.hardware) processes.insert(node.process);
  return processes;
}

// Returns the process that draws the picture. Without hardware there is nothing to draw, which any of them finds out.
std::string painter(const graph::Graph& graph) {
  const std::set<std::string> processes = processes_of_hardware(graph);
  return processes.empty() ? graph::processes_of(graph).front().name : *processes.begin();
}

}  // namespace

Status check_outputs(const graph::Graph& graph, const host::RunOutputs& outputs) {
  if (!outputs.trace_file.empty() && graph::processes_of(graph).size() > 1)
    return fail(
        Code::invalid_argument,
        std::string("--trace writes down in one order all that happens, and several processes have no order "
                    "in common") +
            kOtherwise);
  for (const host::RecordingOptions& recording : outputs.recordings) {
    if (host::is_bag_file(recording.file)) continue;  // a process of its own writes it
    if (const auto processes = processes_of_ports(graph, recording); processes.size() > 1)
      return fail(Code::invalid_argument, "--record " + recording.file +
                                              ": one process writes it, and the ports are in several: " +
                                              listed_names(processes) + "; give each a file of its own");
  }
  if (const auto processes = processes_of_hardware(graph);
      !outputs.picture.file.empty() && processes.size() > 1)
    return fail(Code::invalid_argument, "--picture: one process draws it, and the hardware is in several: " +
                                            listed_names(processes) + kOtherwise);
  return ok();
}

host::RunOutputs outputs_of(const graph::Graph& graph, const std::string& process,
                            const host::RunOutputs& outputs) {
  host::RunOutputs own = outputs;
  std::erase_if(own.recordings, [&](const host::RecordingOptions& recording) {
    return !processes_of_ports(graph, recording).contains(process);
  });
  if (!own.picture.file.empty() && painter(graph) != process) own.picture = {};
  return own;
}

}  // namespace orca::supervisor
