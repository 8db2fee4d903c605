// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"

namespace orca::graph {

/// A hardware container, as far as a component's contract may depend on it.
struct HardwareUse {
  std::string name;
  std::string type;
  Params params;  ///< Complete, in SI, files absolute.
};

/// The refusal of a component's configure().
struct ComponentFault {
  std::string component;  ///< Its name in the graph.
  std::string param;      ///< The parameter to correct; empty: none alone.
  std::string text;       ///< What was found and what was expected.
};

/// The components of a graph whose configure() is to be tried.
struct Candidates {
  std::vector<std::string> names;  ///< In the order in which they come up.
  /// Those of `names` that may lack a connection, or another component that must be up before them. Only what they
  /// say about the value of one of their parameters counts: invalid_argument with Error::param.
  std::set<std::string> doubtful;
};

/// The checker's source of knowledge about plugins. The plugin loader implements it; tests have a fake.
///
/// Thread contract: called from the thread that loads the graph, one call at a time.
class Catalogue {
 public:
  Catalogue() = default;
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;
  virtual ~Catalogue() = default;

  /// Adds folders to search for plugins, absolute, after Orca's own. Called once per graph, before any other
  /// question about it.
  virtual void add_folders(const std::vector<std::string>& folders) = 0;

  /// Returns the contract of a hardware type. The checker uses its parameters.
  /// @errors  not_found: no plugin holds the type; the message lists the places searched. Any other code: the
  ///          plugin exists but cannot be used; the message tells why.
  [[nodiscard]] virtual Result<Contract> hardware(const std::string& type) = 0;

  /// Checks the values of a hardware container's parameters, and the files that they name, such as
  /// world and robot.
  /// @return the errors; empty if there are none.
  [[nodiscard]] virtual std::vector<HardwareFault> validate_hardware(const HardwareUse& use) = 0;

  /// Compares a hardware container with one that the graph names earlier.
  /// @pre  validate_hardware() has found no errors in either of them.
  /// @return the errors of `use`, for instance a serial port that both want; empty if there are none.
  [[nodiscard]] virtual std::vector<HardwareFault> hardware_conflicts(const HardwareUse& use,
                                                                      const HardwareUse& earlier) = 0;

  /// Returns the contract of a component type.
  /// @param hardware  the hardware that the graph binds to it, or null. The contract of a component that
  ///                  needs hardware and gets none here still has its `needs_hardware` and `params`.
  /// @errors  as hardware(); the message of "does not fit that hardware" names both.
  [[nodiscard]] virtual Result<Contract> component(const std::string& type, const HardwareUse* hardware) = 0;

  /// Announces types that it will be asked for, so that it can load them together. It reports nothing.
  virtual void expect(const std::vector<std::string>& /*types*/) {}

  /// Calls configure() of components as a trial, in a copy of the process, while all hardware is closed.
  ///
  /// @param graph  the components and what connects them, as far as they are known. Others than the candidates are
  ///               there, but are not configured.
  /// @pre  all questions about their types and hardware have been asked, and answered without errors.
  /// @return what they refuse, at most one fault per component; empty: nothing, or it could not be tried.
  [[nodiscard]] virtual std::vector<ComponentFault> try_components(const Graph& graph,
                                                                   const Candidates& candidates) = 0;

  /// Returns why a type cannot be part of the run that the graph is loaded for; empty: it can. Called only
  /// for types whose contract it has returned.
  [[nodiscard]] virtual std::vector<std::string> unfit(PluginKind kind, const std::string& type) = 0;

  /// Returns the messages of ROS 2 that objects of a type can leave or come as, the usual one first; empty if there are none.
  [[nodiscard]] virtual std::vector<std::string> messages(const std::string& object_type,
                                                          bool leave) const = 0;

  /// Returns every type that could be named, sorted, for "did you mean".
  [[nodiscard]] virtual std::vector<std::string> type_names(PluginKind kind) const = 0;
};

}  // namespace orca::graph
