// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "link_tree.hpp"
#include "orca/geometry/vec2.hpp"

namespace orca::hw {

/// Returns the size of the rectangle around the origin that holds the plan of all collision geometry [m], as the simulator tells
/// it: 0 and 0 if a round part in the middle holds all others. Nothing if the file has none, or meshes, which it does not read.
/// @thread  pure function; any thread.
[[nodiscard]] std::optional<Vec2> plan_size(const xml::Element& robot, const LinkTree& tree);

}  // namespace orca::hw
