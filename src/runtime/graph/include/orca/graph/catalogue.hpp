// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

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

  /// Compares a hardware container with one of the same type that the graph names earlier.
  /// @pre  validate_hardware() has found no errors in either of them.
  /// @return the errors of `use`, for instance a serial port that both want; empty if there are none.
  [[nodiscard]] virtual std::vector<HardwareFault> hardware_conflicts(const HardwareUse& use,
                                                                      const HardwareUse& earlier) = 0;

  /// Returns the contract of a component type.
  /// @param hardware  the hardware that the graph binds to it, or null. The contract of a component that
  ///                  needs hardware and gets none here still has its `needs_hardware` and `params`.
  /// @errors  as hardware(); the message of "does not fit that hardware" names both.
  [[nodiscard]] virtual Result<Contract> component(const std::string& type, const HardwareUse* hardware) = 0;

  /// Returns why a type cannot be part of the run that the graph is loaded for; empty: it can. Called only
  /// for types whose contract it has returned.
  [[nodiscard]] virtual std::vector<std::string> unfit(PluginKind kind, const std::string& type) = 0;

  /// Returns every type that could be named, sorted, for "did you mean".
  [[nodiscard]] virtual std::vector<std::string> type_names(PluginKind kind) const = 0;
};

}  // namespace orca::graph
