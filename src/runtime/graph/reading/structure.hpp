// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>

#include "arguments.hpp"
#include "node.hpp"
#include "orca/xml/document.hpp"
#include "report.hpp"

namespace orca::graph {

// One file as nodes that follow the rules, and what is known about the parts that had to be left out.
struct Structure {
  Node graph;
  // Names given to elements that could not be understood: to miss such a component would be a second error
  // for one cause.
  std::set<std::string> excused;
  // A component without a name, or a file that could not be included: there may be names that nobody knows.
  bool names_incomplete = false;
};

// Checks elements, attributes and their places, and replaces arguments. Nothing if the root is no graph at
// all.
std::optional<Structure> read_structure(const xml::Document& document, Arguments& arguments, Report& report);

}  // namespace orca::graph
