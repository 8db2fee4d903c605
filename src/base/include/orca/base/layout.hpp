// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace orca {

/// What to call the two sides of a comparison.
struct LayoutEnds {
  std::string_view from = "at the from end";
  std::string_view to = "at the to end";
};

/// Where two layouts of one type first differ, for people: the field's path and what it is at either end.
///
/// @param from, to  flattened layouts as TypeId::layout has them.
[[nodiscard]] std::string layout_difference(std::string_view from, std::string_view to,
                                            const LayoutEnds& ends = {});

}  // namespace orca
