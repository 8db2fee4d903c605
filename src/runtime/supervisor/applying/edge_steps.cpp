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

// What one component does in a step, or how it goes back.
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
  std::set<std::string> left;  // edges of before to servers in other processes
};

// The steps in their order, each for several components.
enum Stage { kServersBegin, kClients, kServersEnd };
using Stages = std::array<std::map<std::string, Duties>, 3>;

class StageMaker {
 public:
  explicit StageMaker(const graph::Graph& graph) : graph_(graph) {}

  // Before a client has obeyed, the server's end of what it has does not change.
  Status add(const graph::GraphPlan::Rewiring& rewiring) {
    const auto& [before, after] = rewiring;
    const Stage of_server = before ? kServersEnd : kServersBegin;
    if (before && goes_out(*before))
      stages_[kClients][before->client().component].left.insert(before->name());
    if (!after) remove(*before, &Duties::go, of_server);
    if (!before) remove(*after, &Duties::back, of_server);
    if (after)
      if (Status made = make(*after, &Duties::go, of_server); !made.ok()) return made;
    return before ? make(*before, &Duties::back, of_server) : ok();
  }

  [[nodiscard]] Stages& stages() { return stages_; }

 private:
  // Returns whether an edge joins two processes.
  [[nodiscard]] bool goes_out(const Edge& edge) const {
    const auto process_of = [this](const graph::PortRef& port) -> const std::string& {
      return graph_.find_component(port.component)->process;
    };
    return process_of(edge.from) != process_of(edge.to);
  }

  // Has both ends of an edge made, on the way there or back. On the way back the ends of an edge get new memory even if
  // only one of them was removed.
  Status make(const Edge& edge, Duty Duties::*way, Stage of_server) {
    auto& at_client = (stages_[kClients][edge.client().component].*way).makes;
    if (!goes_out(edge)) {
      at_client.push_back({edge});
      return ok();
    }
    const Result<MemoryFile> memory = RingSegment::create(edge.name());
    if (!memory) return memory.error();
    at_client.push_back({edge, true, copy_of(*memory)});
    (stages_[of_server][edge.server().component].*way).makes.push_back({edge, true, copy_of(*memory)});
    return ok();
  }

  void remove(const Edge& edge, Duty Duties::*way, Stage of_server) {
    (stages_[kClients][edge.client().component].*way).removes.push_back({edge, false});
    if (goes_out(edge)) (stages_[of_server][edge.server().component].*way).removes.push_back({edge, false});
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
JointStep step_of(const std::string& component, Duties duties, std::set<std::string>& left) {
  const auto orders = std::make_shared<Duties>(std::move(duties));
  const auto make = [orders]() -> std::optional<ThereAndBack> {
    return ThereAndBack{orders->go.order(), orders->back.order()};
  };
  const auto obeyed = [orders, &left](bool has_gone) {
    if (has_gone) left.insert(orders->left.begin(), orders->left.end());
  };
  return {component, make, obeyed, false};
}

}  // namespace

Result<std::vector<JointStep>> edge_steps(const graph::Graph& graph,
                                          const std::vector<graph::GraphPlan::Rewiring>& connections,
                                          const std::set<std::string>& lost, std::set<std::string>& left) {
  StageMaker maker(graph);
  const Status added = contain_exhaustion([&] {
    for (const graph::GraphPlan::Rewiring& one : connections)
      if (Status done = maker.add(one); !done.ok()) return done;
    return ok();
  });
  if (!added.ok()) return added.error();
  std::vector<JointStep> steps;
  for (auto& stage : maker.stages())
    for (auto& [component, duties] : stage)
      if (!lost.contains(graph.find_component(component)->process))
        steps.push_back(step_of(component, std::move(duties), left));
  return steps;
}

void cut_off(const std::string& component, const graph::GraphPlan& plan, const graph::Graph& wanted,
             const Members& all) {
  const auto process_of = [&](const graph::PortRef& end) -> const std::string& {
    return wanted.find_component(end.component)->process;
  };
  for (const graph::GraphPlan::Rewiring& one : plan.connections) {
    if (!one.after) continue;
    const bool is_here = one.after->from.component == component;
    const graph::PortRef& here = is_here ? one.after->from : one.after->to;
    const std::string& there = process_of(is_here ? one.after->to : one.after->from);
    if (here.component != component || !plan.renewed.contains(there)) continue;
    if (const auto member = std::ranges::find(all, process_of(here), &Member::name); member != all.end())
      (*member)->tell(CutEdge{one.after->name(), "process " + there + " is being started"});
  }
}

}  // namespace orca::supervisor
