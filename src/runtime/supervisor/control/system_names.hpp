// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/port_list.hpp"
#include "run/member.hpp"

namespace orca::supervisor {

/// The names that an operator uses for the parts of a system. A name that means nothing is answered by the nearest one
/// that does.
///
/// Thread contract: the supervisor's thread.
class SystemNames {
 public:
  /// All of these outlive the object.
  SystemNames(const graph::Graph& graph, const std::vector<graph::ListedPort>& ports,
              const std::vector<Member*>& members)
      : graph_(graph), ports_(ports), members_(members) {}

  /// Find a part by its name.
  /// @errors  not_found.
  [[nodiscard]] Result<const graph::ComponentNode*> component(const std::string& name) const;
  [[nodiscard]] Result<const graph::ListedPort*> port(const std::string& path) const;
  /// Finds the components that a name stands for: one, or all of a group, in the order in which they start.
  [[nodiscard]] Result<std::vector<const graph::ComponentNode*>> component_or_group(
      const std::string& name) const;
  /// Finds a process by its name, or by that of one of its components.
  [[nodiscard]] Result<Member*> process(const std::string& name) const;

  /// Returns the process of a component.
  [[nodiscard]] Member& member_of(const graph::ComponentNode& component) const;
  /// Returns the same if the process takes orders at present.
  /// @errors  unavailable.
  [[nodiscard]] Result<Member*> ready_member_of(const graph::ComponentNode& component) const;
  /// Returns a process if it takes orders at present.
  /// @pre  it is one of this machine.
  /// @errors  unavailable.
  [[nodiscard]] Result<Member*> ready_member(const std::string& process) const;
  /// Returns the process of a hardware element if it takes orders at present.
  /// @errors  unavailable.
  [[nodiscard]] Result<Member*> ready_member_of(const graph::HardwareNode& hardware) const;

 private:
  [[nodiscard]] Member& member(const std::string& process) const;
  static Result<Member*> ready(Member& member);

  const graph::Graph& graph_;
  const std::vector<graph::ListedPort>& ports_;
  const std::vector<Member*>& members_;
};

}  // namespace orca::supervisor
