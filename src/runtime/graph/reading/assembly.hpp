// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "node.hpp"
#include "orca/graph/loader.hpp"
#include "report.hpp"

namespace orca::graph {

// A graph with all the files that it includes and uses, as if everything were written in one file.
struct Assembly {
  Node graph;
  std::map<std::string, Text> parameters;   // see CommandLine
  std::vector<std::string> plugin_folders;  // of all its files, absolute
  std::set<std::string> excused;            // see Structure
  bool names_incomplete = false;            // see Structure
  bool files_missing = false;               // parts of any kind may be in them
  std::deque<Origin> origins;               // the origins that the nodes point to
};

// Reads the files and puts them together. Returns nothing if the document is no graph at all.
std::optional<Assembly> assemble(const xml::Document& document, const LoadOptions& options,
                                 const FileReader& read, Report& report, xml::Diagnostics& diagnostics);

}  // namespace orca::graph
