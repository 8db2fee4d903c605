// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/graph/diff.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/record.hpp"

namespace orca::supervisor {

/// What it takes to carry out a difference between two graphs.
enum class Effort {
  none,      ///< Nothing runs otherwise.
  set,       ///< Parameters change between two laps.
  exchange,  ///< Code is tried, then exchanged between two laps.
  restart,   ///< The system has to be started again.
};

/// The way from a running system to another graph.
struct GraphPlan {
  /// One difference.
  struct Line {
    std::string part;  ///< As graph::title() writes it.
    graph::FieldChange change;
    Effort effort = Effort::none;
  };
  /// A component that gets other code, or the same with other parameters that cannot change while it runs.
  struct Exchange {
    std::string component;
    std::string type;
    graph::Params params;  ///< All of them.
  };

  std::vector<Line> lines;
  std::vector<Exchange> exchanges;  ///< In the order of the graph.
  std::map<std::string, graph::Params>
      settings;  ///< What changes, by component. None of those that get other code.
  /// Returns whether the system can stay up.
  [[nodiscard]] bool is_possible() const;
};

/// Returns the way from one graph to another.
/// @param contracts  of the components of the wanted graph, by component.
/// @thread  pure function; any thread.
[[nodiscard]] GraphPlan plan_of(const graph::Graph& running, const graph::Graph& wanted,
                                const std::map<std::string, Contract>& contracts);

/// Takes over from a wanted graph all that can change while the system runs. The nodes stay where they are.
/// @pre  the plan from one to the other is possible.
void go_over(graph::Graph& graph, const graph::Graph& wanted);

/// Returns a line of a plan for an operator.
[[nodiscard]] Record record_of(const GraphPlan::Line& line);

/// Returns why the system cannot go over to the wanted graph. @pre  the plan is not possible.
[[nodiscard]] std::string obstacles_of(const GraphPlan& plan);

}  // namespace orca::supervisor
