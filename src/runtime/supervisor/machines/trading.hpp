// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "members/member.hpp"
#include "neighbours.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/edge_choice.hpp"

namespace orca::supervisor {

/// The choice for the ports of this machine's processes that have several edges to choose from, and the orders that carry it
/// out.
///
/// Thread contract: the supervisor's thread.
class Trading {
 public:
  /// All of these outlive the object.
  /// @param members     the processes of this machine.
  /// @param reports     on their components.
  /// @param neighbours  the other machines, if there are any. Of their components only the loss of the machine is known.
  Trading(const graph::Graph& graph, const Members& members, const host::Reports& reports,
          std::optional<Neighbours>& neighbours)
      : graph_(graph), members_(members), reports_(reports), neighbours_(neighbours), choice_(graph) {}

  /// Moves the ports whose server is not up to one that is. Call it often, once everything has come up.
  void look();

  /// Tells processes which edges their ports use. New ones need it before their components run.
  /// @pre  they are built.
  void brief(const Members& members) const;

  /// Returns the edges in use of those that ports choose from.
  [[nodiscard]] std::vector<const graph::Edge*> in_use() const { return choice_.in_use(); }

 private:
  [[nodiscard]] host::Standing standing_of(const std::string& component) const;
  [[nodiscard]] Member* member_of(const std::string& component, const Members& members) const;
  static void tell(Member& member, const graph::Edge& edge);

  const graph::Graph& graph_;
  const Members& members_;
  const host::Reports& reports_;
  std::optional<Neighbours>& neighbours_;
  host::EdgeChoice choice_;
};

}  // namespace orca::supervisor
