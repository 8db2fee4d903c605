// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "members/member.hpp"
#include "members/roster.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/supervised_options.hpp"
#include "run_identity.hpp"
#include "wiring.hpp"

namespace orca::supervisor {

inline constexpr Duration kStartLimit = 15s;  ///< For processes that are started together to come up.

using StartOrder = std::vector<std::pair<Member*, std::string>>;  ///< Components, with their processes.

/// Starts host processes and gives them what they need: the graph, the run page, the memory of their edges.
///
/// Thread contract: the supervisor's thread.
class Starter {
 public:
  /// What has become of processes that were to be started.
  struct Begun {
    Members members;            ///< Those that were.
    std::vector<Setup> setups;  ///< For each of them.
    /// The others, and why: errors of HostProcess::start() and RingSegment::create(), or exhaustion.
    std::vector<std::pair<Member*, Error>> failed;
  };

  /// All of these outlive the object.
  /// @param facts  of the graph, also when it changes.
  Starter(const graph::Graph& graph, const SystemFacts& facts, const SupervisedOptions& options,
          const RunIdentity& run, Roster& roster);

  /// Starts processes that do not run, all together, and renews the edges to those that do. One that is asleep takes over
  /// the edges that wait for it. They come up when the caller passes the returned setups on.
  Begun start(const Members& members);

  /// Renews the edges of a process on demand that has ended. They wait for it.
  /// @errors  as RingSegment::create(); unavailable for exhaustion.
  Status renew_edges_of(const Member& member);

  /// Returns the components of processes in the order in which they are configured.
  [[nodiscard]] StartOrder in_start_order(const Members& members) const;

  /// Returns the names of the components that run in a process.
  [[nodiscard]] std::vector<std::string> components_of(const Member& member) const;

  /// Returns how a process is started for which the graph sets nothing.
  [[nodiscard]] HostStart plain_start(const std::string& name) const;

  [[nodiscard]] const Wiring& wiring() const { return wiring_; }
  /// Gives both ends of some edges new memory, in processes that run or are just coming up.
  /// @param edges  by name.
  /// @errors  unavailable if the system gives none.
  Status renew_edges(const std::set<std::string>& edges);
  /// Gives an edge new memory that a process has damaged. One that is damaged again and again stays cut, since whoever writes
  /// there would go on; then a person is to begin one of its processes anew.
  void mend(const std::string& edge, Moment now);
  /// Makes the order that tells of a component which comes, or goes to another process. It has its place in the run page
  /// from then on.
  /// @errors  failed_precondition if the page is full.
  Result<AddComponent> introduce(const graph::ComponentNode& component);
  /// Keeps the state of a component for the case that its process is lost.
  void keep(const StateKept& state) { states_[state.component] = state; }
  /// Makes the orders that tell of processes which begin, or begin anew. All of the graph have their places in the run page
  /// from then on.
  /// @errors  as Roster::reserve().
  Result<std::vector<NoteProcess>> introduce_processes(const graph::Graph& graph,
                                                       const std::set<std::string>& processes);
  using States = std::map<std::string, StateKept>;  // by component
  /// Returns the last state of each component.
  [[nodiscard]] const States& states() const { return states_; }
  /// Keeps these instead.
  void set_states(States states) { states_ = std::move(states); }
  /// Forgets the states of components that the graph does not keep for ever.
  void forget_old_states();
  /// Lets components begin once with the states that are kept of them, whatever the graph says.
  void pass_on_states(std::set<std::string> components) { heirs_ = std::move(components); }
  /// Takes over the edges of the graph, which has others now that are made already.
  void go_over() {
    wiring_.go_over(graph_);
    has_gone_over_ = true;
  }

 private:
  [[nodiscard]] HostStart host_start(const Member& member) const;
  [[nodiscard]] std::vector<std::string> places_of(const std::string& process) const;
  [[nodiscard]] Setup setup(const Member& member, Wiring::Lots& lots);
  [[nodiscard]] std::vector<StateKept> states_for(const Member& member);
  [[nodiscard]] host::RunOutputs outputs_for(const Member& member);
  void renew_others(const Members& started, Wiring::Lots& lots);

  const graph::Graph& graph_;
  const SystemFacts& facts_;
  const SupervisedOptions& options_;
  const RunIdentity& run_;
  Roster& roster_;
  std::vector<std::string> doorbells_;  // the components, in the order of their words in the run page
  Wiring wiring_;
  std::set<std::string> heirs_;    // see pass_on_states()
  std::set<std::string> started_;  // processes that have been started once
  States states_;
  std::map<std::string, std::deque<Moment>> mended_;  // by edge: when, of late
  bool has_gone_over_ = false;                        // to another graph than that of the start
};

}  // namespace orca::supervisor
