// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/graph/diff.hpp"
#include "orca/graph/graph.hpp"

namespace orca::graph {

/// What it takes to carry out a difference between two graphs.
enum class Effort {
  none,      ///< Nothing runs otherwise.
  set,       ///< Parameters change between two laps.
  rewire,    ///< Connections are made or removed between two laps.
  add,       ///< A component comes up beside the others.
  remove,    ///< A component ends when its connections are gone.
  exchange,  ///< Code is tried, then exchanged between two laps.
  renew,     ///< Processes begin, end or are started again.
  restart,   ///< The system has to be started again.
};

/// What can be done to a running system besides what its processes do while they run.
struct PlanMeans {
  bool renews_processes = false;      ///< Processes can be started again while the others run.
  std::optional<Backend> executor{};  ///< Of all processes; nothing: each has its own.
};

/// The way from a running system to another graph.
struct GraphPlan {
  /// One difference.
  struct Line {
    std::string part;  ///< As title() writes it.
    FieldChange change;
    Effort effort = Effort::none;
  };
  /// A component that gets other code, or the same with other parameters that cannot change while it runs.
  struct Exchange {
    std::string component;
    std::string type;
    Params params;  ///< All of them.
  };

  /// A connection that is made, removed or gets another policy.
  struct Rewiring {
    std::optional<Edge> before;  ///< Nothing: it is new.
    std::optional<Edge> after;   ///< Nothing: it goes.
  };

  std::vector<Line> lines;
  std::vector<ComponentNode> added;        ///< In the order in which they start.
  std::vector<std::string> removed;        ///< In the order in which they end.
  std::vector<Rewiring> connections;       ///< Sorted by name.
  std::vector<Exchange> exchanges;         ///< Sorted by component.
  std::map<std::string, Params> settings;  ///< What changes, by component. None of those that get other code.
  /// Processes that begin, end or are started again, by name. What concerns only these is in none of the lists above; of a
  /// connection between one of them and another process, that other one makes its end.
  std::set<std::string> renewed;
  /// Returns the connections whose clients come, or those of all other clients.
  [[nodiscard]] std::vector<Rewiring> connections_of(bool newcomers) const;
  /// Returns whether the system can stay up.
  [[nodiscard]] bool is_possible() const;
};

/// Returns the way from one graph to another.
/// @param contracts  of the components of the wanted graph, by component.
/// @thread  pure function; any thread.
[[nodiscard]] GraphPlan plan_of(const Graph& running, const Graph& wanted,
                                const std::map<std::string, Contract>& contracts, const PlanMeans& means);

/// Returns the way back.
[[nodiscard]] std::vector<GraphPlan::Rewiring> reversed(std::vector<GraphPlan::Rewiring> connections);

/// Makes an edge part of a list, in place of the one of its name, or removes that.
void put(const Edge& edge, bool is_there, std::vector<Edge>& edges);

/// Takes over from a wanted graph all that can change while the system runs. The nodes stay where they are unless components
/// come or go; then they are in the wanted graph's order.
/// @pre  the plan from one to the other is possible.
void go_over(Graph& graph, const Graph& wanted);

/// Returns what it takes, for people: "between two laps; nothing stops".
[[nodiscard]] const char* to_string(Effort effort);

/// Returns why the system cannot go over to the wanted graph. @pre  the plan is not possible.
[[nodiscard]] std::string obstacles_of(const GraphPlan& plan);

}  // namespace orca::graph
