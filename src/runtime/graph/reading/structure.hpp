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
  // Names of elements that could not be understood. Reporting such a component as missing would be a second
  // error for one cause.
  std::set<std::string> excused;
  // There may be unknown names, because a component has no name or a file could not be included.
  bool names_incomplete = false;
};

// Checks elements, attributes and their places, and replaces arguments. Returns nothing if the root is no
// graph at all.
std::optional<Structure> read_structure(const xml::Document& document, Arguments& arguments, Report& report);

}  // namespace orca::graph
