// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"

namespace orca::supervisor {

// The graphs that an operator asks for with a few words instead of a file, as texts to be read and checked like a file.
//
// Thread contract of all functions here: pure; any thread.

/// Returns the graph with a connection, in place of the one of the same ends.
/// @param words  the two ports in the order of <connect>, then ATTRIBUTE=VALUE as in a graph.
/// @errors  invalid_argument if a word is no attribute.
[[nodiscard]] Result<std::string> with_connection(graph::Graph graph, const std::vector<std::string>& words);

/// Returns the graph without a connection.
/// @errors  not_found.
[[nodiscard]] Result<std::string> without_connection(graph::Graph graph, const std::string& from,
                                                     const std::string& to);

/// Returns the graph with the only connection of a client's port leading to another server, with the same policy.
/// @errors  not_found; failed_precondition if the port has several; invalid_argument if it is a server's, or if a component does not exist.
[[nodiscard]] Result<std::string> with_other_server(graph::Graph graph, const std::string& client,
                                                    const std::string& server);

}  // namespace orca::supervisor
