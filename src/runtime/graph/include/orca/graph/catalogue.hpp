// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"

namespace orca::graph {

/// A hardware container as a component's contract may depend on it.
struct HardwareUse {
  std::string name;
  std::string type;
  Params params;  ///< Complete, in SI, files absolute.
};

/// What the checker asks about plugins. The plugin loader implements it; tests have a fake.
///
/// Thread contract: called from the thread that loads the graph, one call at a time.
class Catalogue {
 public:
  Catalogue() = default;
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;
  virtual ~Catalogue() = default;

  /// More folders to search for plugins, absolute, after Orca's own. Called once per graph, before any other
  /// question about it.
  virtual void add_folders(const std::vector<std::string>& folders) = 0;

  /// The contract of a hardware type; its parameters count.
  /// @errors  not_found: no plugin holds the type; the message says where was searched. Any other code: the
  ///          plugin is there and cannot be used, and the message says why.
  [[nodiscard]] virtual Result<Contract> hardware(const std::string& type) = 0;

  /// Looks at the values of a hardware container's parameters, and into the files that they name (world,
  /// robot, ...).
  /// @return what is wrong; empty if all is well.
  [[nodiscard]] virtual std::vector<HardwareFault> validate_hardware(const HardwareUse& use) = 0;

  /// The contract of a component type.
  /// @param hardware  what the graph binds it to, or null. A component that needs hardware and gets none here
  ///                  still has its `needs_hardware` and `params` in the contract.
  /// @errors  as hardware(); the message of "does not fit that hardware" names both.
  [[nodiscard]] virtual Result<Contract> component(const std::string& type, const HardwareUse* hardware) = 0;

  /// Why a type that is there cannot be part of the run that the graph is loaded for; empty: it can. Asked
  /// only about types that it has given a contract of.
  [[nodiscard]] virtual std::vector<std::string> unfit(PluginKind kind, const std::string& type) = 0;

  /// Every type that could be named, sorted: for "did you mean".
  [[nodiscard]] virtual std::vector<std::string> type_names(PluginKind kind) const = 0;
};

}  // namespace orca::graph
