// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/xml/document.hpp"
#include "scanner.hpp"

namespace orca::xml {

// Builds tinyxml2's tree of a text that was found readable, and adds the positions of the scan in document
// order.
std::optional<Document> build_tree(std::string_view text, const Scan& scan, const std::string& file,
                                   Diagnostics& out);

}  // namespace orca::xml
