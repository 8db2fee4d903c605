// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/sim/world_model.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::sim::detail {

// Reads a <walker> and reports its errors. A faulty track is left empty.
[[nodiscard]] Walker read_walker(const xml::Attributes& element);

// Returns the first obstacle that a walker would run into on its track, or null.
[[nodiscard]] const Obstacle* obstacle_on_track(const Walker& walker, const WorldModel& world);

}  // namespace orca::sim::detail
