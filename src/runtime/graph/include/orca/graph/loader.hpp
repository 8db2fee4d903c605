// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/graph/catalogue.hpp"
#include "orca/graph/graph.hpp"
#include "orca/xml/diagnostics.hpp"
#include "orca/xml/document.hpp"

namespace orca::graph {

/// The command line's settings for a graph.
struct LoadOptions {
  /// Merged in this order; none: the graph's default_profile.
  std::vector<std::string> profiles{};
  /// "ARG=VALUE" for an argument of the file, "COMPONENT.PARAM=VALUE" for a parameter of a component or hardware, which has
  /// precedence over the graph and its profiles. A relative path in VALUE starts at the current folder.
  std::vector<std::string> settings{};
  bool strict = false;          ///< Warnings are errors.
  bool try_components = false;  ///< Also call configure() of the components, as a trial.
  /// Components that --fail on the command line names; each must be there.
  std::vector<std::string> failing{};
  /// Ports ("component.port") that --record on the command line names; each must be there.
  std::vector<std::string> recorded{};
  /// A link within a process that needs two is no error, because nothing needs it: the run is in virtual time and so in
  /// one process, or nothing is run.
  bool any_link = false;
  /// Profiles and settings are those of a run that goes on; a graph that says expanded="true" has them already.
  bool of_run = false;
  /// Gets the changes that the graph names, also if the graph or the time of a change is wrong; null: nobody wants them.
  std::vector<PlannedChange>* changes = nullptr;
  /// Name of the system, in place of the one that the graph has; empty: that. With it a graph can run twice at a time.
  std::string name{};
  /// DDS domain, in place of the one that the graph says; nothing: that.
  std::optional<std::uint32_t> domain{};
};

/// A function that returns the text of an included file. The path starts at the current folder.
using FileReader = std::function<Result<std::string>(const std::string& path)>;

/// Reads a system graph and checks it against the contracts of its plugins. It starts nothing.
///
/// @param diagnostics  receives all errors and warnings of the whole graph (docs/errors.md), not just one.
/// @return the graph, if there is no error at all.
/// @thread  one call per Catalogue at a time. Reads the current folder, to make paths absolute.
[[nodiscard]] std::optional<Graph> load_file(const std::string& path, const LoadOptions& options,
                                             Catalogue& catalogue, xml::Diagnostics& diagnostics);

/// Reads a graph from a text in memory. `file_name` appears in positions. Relative paths start at its folder.
///
/// @param read  returns the files that it includes.
[[nodiscard]] std::optional<Graph> load_text(std::string_view text, const std::string& file_name,
                                             const LoadOptions& options, Catalogue& catalogue,
                                             xml::Diagnostics& diagnostics,
                                             const FileReader& read = xml::read_bytes);

}  // namespace orca::graph
