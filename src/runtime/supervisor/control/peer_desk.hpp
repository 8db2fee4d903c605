// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "control/operating.hpp"
#include "control/system_names.hpp"
#include "members/conductor.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/component_report.hpp"
#include "orca/host/peer_call.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The place at which components order others about: parameters and pauses, by rights that the graph gives.
///
/// Thread contract: the supervisor's thread.
class PeerDesk {
 public:
  /// All of these outlive the object.
  PeerDesk(Conductor& conductor, const graph::Graph& graph, const SystemNames& names, Operating& operating,
           host::Reports reports)
      : conductor_(conductor),
        graph_(graph),
        names_(names),
        operating_(operating),
        reports_(std::move(reports)) {}

  /// Carries out what a component orders about another one, and gives it the outcome. Never waits.
  /// @param process  which says so.
  /// @errors  data_loss if that process does not have the component.
  [[nodiscard]] Status take(const PeerCalled& called, const std::string& process);
  /// Lets components go on that were suspended for others which have ended, or whose processes are lost. Never waits.
  void go_on();
  /// Notes that an operator orders a pause of a component, or of a group, or its end: from now on it is his.
  void overrule(const std::string& name);

 private:
  Result<std::string> obey(const host::PeerCall& call);
  Result<bool> pause(const host::PeerCall& call, bool suspends);

  Conductor& conductor_;
  const graph::Graph& graph_;
  const SystemNames& names_;
  Operating& operating_;
  const host::Reports reports_;
  host::PeerPauses pauses_;
  bool lets_go_ = false;  // a job does
};

}  // namespace orca::supervisor
