// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace orca {

/// The names of the two sides of a comparison.
struct LayoutEnds {
  std::string_view from = "at the from end";
  std::string_view to = "at the to end";
};

/// Returns, for people, where two layouts of one type first differ: the field's path and its type at either
/// end.
///
/// @param from, to  flattened layouts, as in TypeId::layout.
[[nodiscard]] std::string layout_difference(std::string_view from, std::string_view to,
                                            const LayoutEnds& ends = {});

}  // namespace orca
