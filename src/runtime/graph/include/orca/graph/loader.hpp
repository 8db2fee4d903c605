// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/xml/diagnostics.hpp"
#include "orca/xml/document.hpp"

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

/// What the command line says about a graph.
struct LoadOptions {
  std::vector<std::string> profiles;  ///< Merged in this order; none: the graph's default_profile.
  std::vector<std::string> settings;  ///< "ARG=VALUE"; a relative path in VALUE starts at the current folder.
  bool strict = false;                ///< Warnings are errors.
};

/// Where the text of a file comes from that a graph includes. The path starts at the current folder.
using FileReader = std::function<Result<std::string>(const std::string& path)>;

/// Reads new values for some of a component's parameters as a graph would, for a change at run time.
///
/// @param texts  by name: "0.5 m", "true", ...
/// @errors  invalid_argument with everything that is wrong, a line each.
[[nodiscard]] Result<Params> read_settings(const std::vector<ParamContract>& contracts,
                                           const std::map<std::string, std::string>& texts);

/// Reads a system graph and checks it against the contracts of its plugins. It loads nothing and starts
/// nothing.
///
/// @param diagnostics  receives all errors and warnings of the whole graph (docs/errors.md), not only the
/// first.
/// @return the graph, if there is no error at all.
/// @thread  one call per Catalogue at a time. Reads the current folder, to make paths absolute.
[[nodiscard]] std::optional<Graph> load_file(const std::string& path, const LoadOptions& options,
                                             Catalogue& catalogue, xml::Diagnostics& diagnostics);

/// The same for text in memory. `file_name` appears in positions, and relative paths start at its folder.
///
/// @param read  for the files that it includes.
[[nodiscard]] std::optional<Graph> load_text(std::string_view text, const std::string& file_name,
                                             const LoadOptions& options, Catalogue& catalogue,
                                             xml::Diagnostics& diagnostics,
                                             const FileReader& read = xml::read_bytes);

}  // namespace orca::graph
