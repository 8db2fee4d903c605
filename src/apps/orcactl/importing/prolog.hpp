// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "orca/xml/diagnostics.hpp"

namespace orca::orcactl::importing {

/// Returns a file's text as Orca's strict reader takes it: in UTF-8, without its DOCTYPE and without end tags that close nothing.
/// Everything else keeps its line and column.
/// @param out  receives a warning for each end tag that was left out.
/// @thread pure function; any thread.
[[nodiscard]] std::string made_strict(std::string text, const std::string& file_name, xml::Diagnostics& out);

}  // namespace orca::orcactl::importing
