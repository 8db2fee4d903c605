// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "members/reply.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/system_facts.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The parameters that the components and drivers of this machine have now: those of the code that runs, which may be another than
/// the graph names, with the values that were set. An owner is a component or a driver, by its name in the graph.
///
/// Thread contract: the supervisor's thread.
class PresentParams {
 public:
  /// Both outlive the object.
  PresentParams(const graph::Graph& graph, const SystemFacts& facts) : graph_(graph), facts_(facts) {}

  /// Returns the contract of the code that an owner runs, with its parameters at least; null: it is not known.
  [[nodiscard]] const Contract* contract_of(const std::string& owner) const;
  /// Returns the values of an owner.
  /// @param in_graph  its values in the graph.
  [[nodiscard]] graph::Params of(const std::string& owner, graph::Params in_graph) const;
  /// Returns the file of a driver's code.
  [[nodiscard]] std::string plugin_of(const graph::HardwareNode& hardware) const;
  /// The names of the parameters of all components, for completion.
  void add_names(Reply& reply) const;

  /// Notes that new code has taken over, with parameters of its own.
  void note(const ExchangedCode& code);
  /// Notes that a value was set.
  void set(const std::string& owner, const std::string& param, const ParamValue& value);
  /// Forgets an owner that has gone, or runs the graph's code with its values again.
  void forget(const std::string& owner);
  /// Forgets all values that were set, since the graph says the same now.
  void forget_changes();

 private:
  // What has taken the place of the graph's code.
  struct Exchanged {
    Contract contract;  // its parameters only
    graph::Params values;
    std::string file;
  };

  const graph::Graph& graph_;
  const SystemFacts& facts_;
  std::map<std::string, Exchanged> exchanged_;    // by owner
  std::map<std::string, graph::Params> changed_;  // by owner: what is not as above or in the graph
};

}  // namespace orca::supervisor
