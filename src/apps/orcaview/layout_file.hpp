// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "orca/base/result.hpp"

namespace orca::view {

/// Returns the file beside a graph that says where the page shows components which hands have moved: "my.layout.json" of
/// "my.xml".
[[nodiscard]] std::string layout_file_of(const std::string& graph_file);

/// Returns the layout of a graph, a JSON object with two numbers [pixels] for each component: {"goto":[120,40]}. Without a file it
/// has none.
/// @errors  unavailable if the file cannot be read; data_loss if it is no layout.
/// @thread  any.
[[nodiscard]] Result<std::string> read_layout(const std::string& graph_file);

/// Writes the layout of a graph: the file is written whole beside the old one, and takes its place then. An empty layout removes it.
/// @errors  invalid_argument if `layout` is none; failed_precondition if there is a file which is none; unavailable if the file
///          cannot be written.
/// @thread  any; one of a file at a time.
Status keep_layout(const std::string& graph_file, const std::string& layout);

}  // namespace orca::view
