// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "orca/graph/graph.hpp"
#include "orca/host/component_report.hpp"

namespace orca::host {

/// How well a component can serve others.
struct Standing {
  bool is_up = true;       ///< It can, perhaps after it has been loaded.
  std::string why_down{};  ///< Why it cannot and will not by itself; empty: it can, or it is just coming up.
};

/// Returns the standing of a component. It is down if it has failed or its process is gone.
/// @thread  any.
[[nodiscard]] Standing standing_of(const ComponentReport& report);

/// The edges that are in use of those among which ports choose. A port uses the first of its choices that is up, and stays
/// with it until that is down, even if a better one comes back. If none is up, it stays as well.
///
/// Thread contract: not synchronised.
class EdgeChoice {
 public:
  using Standings = std::function<Standing(const std::string& component)>;

  /// A move of a port from one server to another.
  struct Move {
    const graph::Edge* edge;  ///< That the port uses from now on; lives as long as the EdgeChoice.
    std::string text;         ///< For people, without the component's name.
  };

  /// All ports use their first choice.
  explicit EdgeChoice(const graph::Graph& graph);

  /// Chooses anew for all ports whose server is down.
  /// @return the moves that follow, in the order of the graph.
  [[nodiscard]] std::vector<Move> look(const Standings& standings);

  /// Returns the edges in use, in the order of the graph. They live as long as the EdgeChoice.
  [[nodiscard]] std::vector<const graph::Edge*> in_use() const;

 private:
  struct Port {
    std::vector<graph::Edge> edges;  // in the order of choice
    std::size_t used = 0;
  };

  std::vector<Port> ports_;
};

}  // namespace orca::host
