// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/xml/rules.hpp"

namespace orca::graph {

// Returns the rules of graph files: the root first, the others in the order of the schema.
const xml::FileRules& graph_rules();

// Returns whether the element brings in another file.
bool brings_file(const xml::ElementRule& rule);
// Returns the attribute of such an element that names the file.
const char* file_attribute(const xml::ElementRule& rule);

}  // namespace orca::graph
