// SPDX-License-Identifier: LGPL-3.0-or-later
#include "run_identity.hpp"

#include <cstdint>
#include <random>
#include <utility>

#include "hosted/graph_mark.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"

namespace orca::supervisor {
namespace {

// The name of a run on several machines is the same for all of them, and for one that is started again.
std::string run_name(const graph::Graph& graph) {
  if (graph.machines.size() > 1) return std::to_string(mark_of(graph::print(graph)));
  std::random_device device;
  return std::to_string((std::uint64_t{device()} << 32) | device());
}

}  // namespace

Result<RunIdentity> begin_run(const graph::Graph& graph, const std::string& machine) {
  Result<RunPage> page = RunPage::create(graph::processes_on(graph, machine).size(), graph.components.size());
  if (!page) return page.error();
  return RunIdentity{std::move(page).value(), steady_now(), run_name(graph)};
}

}  // namespace orca::supervisor
