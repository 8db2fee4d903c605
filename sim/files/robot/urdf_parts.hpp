// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

#include "orca/xml/document.hpp"

namespace orca::sim::detail {

// The first child of that name, or null.
[[nodiscard]] const xml::Element* only_child(const xml::Element& element, std::string_view name);

// Names, parents, roots, loops, mimics.
void check_tree(const xml::Element& robot, xml::Diagnostics& diagnostics);

}  // namespace orca::sim::detail
