// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/graph/diff.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/plan.hpp"

namespace orca::graph {

/// Two graphs that a running system goes from and to.
struct Way {
  const Graph& running;
  const Graph& wanted;
  const std::map<std::string, Contract>& contracts;  ///< Of the components of the wanted graph, by component.
  const PlanMeans& means;
};

/// Returns the value's name if a field of a component is a parameter; otherwise nothing.
[[nodiscard]] std::string param_of(const FieldChange& change);

/// Returns whether a change of a component's field is one of its code or its parameters, so that it can be exchanged.
[[nodiscard]] bool concerns_code(const FieldChange& change);

/// Returns whether a change of the code or the parameters of a component needs no new code.
[[nodiscard]] bool only_sets(const Change& change, const Contract* contract);

/// Returns whether a connection is made and removed by its ends alone: its port uses no other one in its place.
[[nodiscard]] bool is_plain(const Edge& edge);

/// Returns the processes of either graph that have to begin, to end or to be started again: what differs in them cannot change
/// while they run.
/// @param changes  the differences of the two graphs.
/// @thread  pure function; any thread.
[[nodiscard]] std::set<std::string> processes_to_renew(const Way& way, const std::vector<Change>& changes);

/// Returns whether the components of all connections that ports choose from are where they were, and have the same ones.
[[nodiscard]] bool keeps_choices(const Way& way);

}  // namespace orca::graph
