// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/xml/rules.hpp"

namespace orca::graph {

// The rules of graph files; the root comes first, the others in the order of the schema.
const xml::FileRules& graph_rules();

// Whether the element brings in another file.
bool brings_file(const xml::ElementRule& rule);
// The attribute of such an element that names the file.
const char* file_attribute(const xml::ElementRule& rule);

}  // namespace orca::graph
