// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "members/member.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/port_list.hpp"

namespace orca::supervisor {

/// The names that an operator uses for the parts of a system. A name that means nothing is answered by the nearest one
/// that does, and one of a part that runs on another machine by the name of that machine: only its deployer can command it.
///
/// Thread contract: the supervisor's thread.
class SystemNames {
 public:
  /// All of these outlive the object.
  /// @param whole  the graph of the whole system.
  /// @param here   what of it runs on this machine.
  /// @param ports  those of the whole system.
  SystemNames(const graph::Graph& whole, const graph::Graph& here,
              const std::vector<graph::ListedPort>& ports, const std::vector<Member*>& members)
      : whole_(whole), here_(here), ports_(ports), members_(members) {}

  // All of the following find what runs on this machine, unless something else is said.
  // @errors  not_found; failed_precondition if it runs on another machine.

  /// Finds a component by its name.
  [[nodiscard]] Result<const graph::ComponentNode*> component(const std::string& name) const;
  /// Returns all ports, on whatever machine.
  [[nodiscard]] const std::vector<graph::ListedPort>& ports() const { return ports_; }
  /// Finds a port by its name, "component.port", on whatever machine.
  /// @errors  not_found.
  [[nodiscard]] Result<const graph::ListedPort*> port(const std::string& path) const;
  /// Finds the components that a name stands for: one, or all of a group, in the order in which they start.
  [[nodiscard]] Result<std::vector<const graph::ComponentNode*>> component_or_group(
      const std::string& name) const;
  /// Finds a process by its name, or by that of one of its components.
  [[nodiscard]] Result<Member*> process(const std::string& name) const;

  /// Returns the graph of this machine, with the connections of a component to those on others.
  [[nodiscard]] graph::Graph surroundings_of(const std::string& component) const;

  /// Returns a note on what is only this machine's, that names the others; nothing: there are none.
  [[nodiscard]] std::optional<std::string> other_machines() const;

  /// Returns the process of a component.
  [[nodiscard]] Member& member_of(const graph::ComponentNode& component) const;
  /// Returns the same if the process takes orders at present.
  /// @errors  unavailable.
  [[nodiscard]] Result<Member*> ready_member_of(const graph::ComponentNode& component) const;
  /// Returns the process of a component if it has its ports at present, even before it works.
  /// @errors  unavailable.
  [[nodiscard]] Result<Member*> built_member_of(const graph::ComponentNode& component) const;
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
  [[nodiscard]] Error elsewhere(const std::string& what, const std::string& process) const;
  [[nodiscard]] Error spread(const graph::GroupNode& group) const;
  [[nodiscard]] std::string machine_of(const std::string& process) const;

  const graph::Graph& whole_;
  const graph::Graph& here_;
  const std::vector<graph::ListedPort>& ports_;
  const std::vector<Member*>& members_;
};

}  // namespace orca::supervisor
