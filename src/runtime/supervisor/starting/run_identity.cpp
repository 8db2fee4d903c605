// SPDX-License-Identifier: LGPL-3.0-or-later
#include "run_identity.hpp"

#include <cstdint>
#include <random>
#include <utility>

#include "agreed/graph_mark.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"

namespace orca::supervisor {
namespace {

constexpr std::size_t kMostNewcomers = 256;    // that may be added to a run; a cache line of memory each
constexpr std::size_t kMostNewProcesses = 16;  // the same of processes

// The name of a run on several machines is the same for all of them, and for one that is started again.
std::string run_name(const graph::Graph& graph) {
  if (graph.machines.size() > 1) return std::to_string(mark_of(graph::print(graph)));
  std::random_device device;
  return std::to_string((std::uint64_t{device()} << 32) | device());
}

}  // namespace

Result<RunIdentity> begin_run(const graph::Graph& graph, const std::string& machine) {
  std::vector<std::string> doorbells;
  for (const graph::ComponentNode& node : graph.components) doorbells.push_back(node.name);
  std::vector<std::string> processes;
  for (const graph::ProcessNode& node : graph::processes_on(graph, machine)) processes.push_back(node.name);
  processes.resize(processes.size() + kMostNewProcesses);
  Result<RunPage> page = RunPage::create(processes.size(), doorbells.size() + kMostNewcomers);
  if (!page) return page.error();
  return RunIdentity{std::move(page).value(), steady_now(), run_name(graph), std::move(doorbells),
                     std::move(processes)};
}

}  // namespace orca::supervisor
