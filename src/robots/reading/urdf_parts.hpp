// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::robots::detail {

// Returns the first child of that name, or null.
[[nodiscard]] const xml::Element* only_child(const xml::Element& element, std::string_view name);

// Checks names, parents, roots, loops and mimics.
void check_tree(const xml::Element& robot, xml::Reporter& reporter);

}  // namespace orca::robots::detail
