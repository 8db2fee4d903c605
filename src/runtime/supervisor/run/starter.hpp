// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "bring_up.hpp"
#include "member.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/supervised_run.hpp"
#include "run_identity.hpp"
#include "wiring.hpp"

namespace orca::supervisor {

/// Starts host processes and gives them what they need: the graph, the run page, the memory of their edges.
///
/// Thread contract: the supervisor's thread.
class Starter {
 public:
  /// All of these outlive the object.
  Starter(const graph::Graph& graph, const SupervisedOptions& options, const RunIdentity& run,
          const Members& all);

  /// Starts processes that do not run, all together, and renews the edges to those that do. The bring-up begins when
  /// the caller calls begin() with the returned setups.
  /// @errors  as HostProcess::start() and RingSegment::create(); the processes that were started then run on.
  Result<std::vector<Setup>> start(const Members& members);

  /// Returns the plan by which these processes come up.
  [[nodiscard]] BringUp::Plan plan(const Members& members) const;

  /// Returns the names of the components that run in a process.
  [[nodiscard]] std::vector<std::string> components_of(const Member& member) const;

  /// Returns how a process is started for which the graph sets nothing.
  [[nodiscard]] HostStart plain_start(const std::string& name) const;

  [[nodiscard]] const Wiring& wiring() const { return wiring_; }

 private:
  [[nodiscard]] HostStart host_start(const Member& member) const;
  [[nodiscard]] Setup setup(const Member& member, std::vector<EdgeMemory> edges);
  [[nodiscard]] host::RunOutputs outputs_for(const Member& member);
  void renew_others(const Members& started, Wiring::Lots& lots);

  const graph::Graph& graph_;
  const SupervisedOptions& options_;
  const RunIdentity& run_;
  const Members& all_;
  const std::string graph_text_;
  const Wiring wiring_;
  std::set<std::string> started_;  // processes that have been started once
};

}  // namespace orca::supervisor
