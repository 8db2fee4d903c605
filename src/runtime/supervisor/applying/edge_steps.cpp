// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/edge_steps.hpp"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/shared_memory.hpp"
#include "orca/patterns/shm/ring_segment.hpp"

namespace orca::supervisor {
namespace {

using graph::Edge;

// What one process does in a step, and how it goes back.
struct Duty {
  std::vector<EdgeChange> makes;
  std::vector<EdgeChange> removes;

  [[nodiscard]] Rewire order() {
    Rewire all{std::move(makes)};
    std::ranges::move(removes, std::back_inserter(all.changes));
    return all;
  }
};
struct Duties {
  Duty go;
  Duty back;
};

// The steps in their order, each for several processes.
enum Stage { kServersBegin, kClients, kServersEnd };
using Stages = std::array<std::map<std::string, Duties>, 3>;

class StageMaker {
 public:
  explicit StageMaker(const graph::Graph& graph) : graph_(graph) {}

  Status add(const graph::GraphPlan::Rewiring& rewiring) {
    if (rewiring.after)
      if (Status made = make(*rewiring.after, &Duties::go); !made.ok()) return made;
    if (!rewiring.after) remove(*rewiring.before, &Duties::go, kServersEnd);
    if (rewiring.before)
      if (Status made = make(*rewiring.before, &Duties::back); !made.ok()) return made;
    if (!rewiring.before) remove(*rewiring.after, &Duties::back, kServersBegin);
    return ok();
  }

  [[nodiscard]] Stages& stages() { return stages_; }

 private:
  [[nodiscard]] const std::string& process_of(const graph::PortRef& port) const {
    return graph_.find_component(port.component)->process;
  }

  // Has both ends of an edge made, on the way there or back. On the way back the ends of an edge get new memory even if
  // only one of them was removed.
  Status make(const Edge& edge, Duty Duties::*way) {
    const std::string& server = process_of(edge.server());
    const std::string& client = process_of(edge.client());
    if (server == client) {
      (stages_[kClients][client].*way).makes.push_back({edge});
      return ok();
    }
    const Result<MemoryFile> memory = RingSegment::create(edge.name());
    if (!memory) return memory.error();
    (stages_[kServersBegin][server].*way).makes.push_back({edge, true, copy_of(*memory)});
    (stages_[kClients][client].*way).makes.push_back({edge, true, copy_of(*memory)});
    return ok();
  }

  void remove(const Edge& edge, Duty Duties::*way, Stage stage_of_server) {
    const std::string& server = process_of(edge.server());
    const std::string& client = process_of(edge.client());
    (stages_[kClients][client].*way).removes.push_back({edge, false});
    if (server != client) (stages_[stage_of_server][server].*way).removes.push_back({edge, false});
  }

  static Descriptor copy_of(const MemoryFile& memory) {
    Descriptor copy(fcntl(memory.descriptor(), F_DUPFD_CLOEXEC, 3));
    if (!copy) throw_if_exhausted(errno);
    return copy;
  }

  const graph::Graph& graph_;
  Stages stages_;
};

// The orders are made once, since they hold the memory.
JointStep step_of(const graph::Graph& graph, const std::string& process, Duties duties) {
  const auto component = std::ranges::find(graph.components, process, &graph::ComponentNode::process);
  const auto orders = std::make_shared<Duties>(std::move(duties));
  const auto make = [orders]() -> std::optional<ThereAndBack> {
    return ThereAndBack{orders->go.order(), orders->back.order()};
  };
  return {component->name, make, [](bool) {}};
}

}  // namespace

Result<std::vector<JointStep>> edge_steps(const graph::Graph& graph,
                                          const std::vector<graph::GraphPlan::Rewiring>& connections,
                                          const std::set<std::string>& lost) {
  StageMaker maker(graph);
  const Status added = contain_exhaustion([&] {
    for (const graph::GraphPlan::Rewiring& one : connections)
      if (Status done = maker.add(one); !done.ok()) return done;
    return ok();
  });
  if (!added.ok()) return added.error();
  std::vector<JointStep> steps;
  for (auto& stage : maker.stages())
    for (auto& [process, duties] : stage)
      if (!lost.contains(process)) steps.push_back(step_of(graph, process, std::move(duties)));
  return steps;
}

}  // namespace orca::supervisor
