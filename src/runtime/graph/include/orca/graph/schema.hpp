// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca::graph {

/// Returns the graph's language as an XML schema, for editors: graphs/orca-graph.xsd. It is made from the
/// rules that the reader follows, but is less strict than the reader: any value may be "${arg}".
[[nodiscard]] std::string schema();

}  // namespace orca::graph
