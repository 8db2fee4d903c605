// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "members/ledger.hpp"
#include "members/member.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/plan.hpp"
#include "orca/supervisor/vocabulary.hpp"
#include "starting/starter.hpp"

namespace orca::supervisor {

/// Tells processes that a component, which another one has, is gone.
void announce_end(const std::string& component, const std::string& process, const Members& all);

/// What the processes that stay hear of components and processes which come, go or begin anew.
///
/// Thread contract: the supervisor's thread.
class Announcing {
 public:
  /// @param running  the graph of the run. All outlive the object.
  Announcing(const graph::Graph& running, const Members& all, Starter& starter, Ledger& ledger)
      : running_(running), all_(all), starter_(starter), ledger_(ledger) {}

  /// Tells them of all that is new to them.
  /// @return the orders to those that construct components.
  /// @errors  unavailable if one of them is just coming up; those of the orders.
  Result<std::vector<AddComponent>> begin(const graph::GraphPlan& plan, const graph::Graph& wanted);
  /// Tells them of the others as they are in the graph of the run, which it goes back to.
  void take_back() const;
  /// Tells them that components of processes which have begun anew are not there any more. Returns their names.
  [[nodiscard]] std::vector<std::string> tell_of_the_gone() const;

 private:
  Result<std::vector<AddComponent>> orders_for(const std::vector<graph::ComponentNode>& components) const;
  Status tell(const std::vector<AddComponent>& components, const graph::Graph& graph) const;

  const graph::Graph& running_;
  const Members& all_;
  Starter& starter_;
  Ledger& ledger_;
  std::set<std::string> renewed_;                // processes that begin, end or begin anew
  std::vector<graph::ComponentNode> newcomers_;  // in them
  std::vector<graph::ComponentNode> gone_;       // from them
};

}  // namespace orca::supervisor
