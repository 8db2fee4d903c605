// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/sim/world_model.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::sim::detail {

// Reads a <walker>, reporting what is wrong; then it has a track that no obstacle is on, or none.
[[nodiscard]] Walker read_walker(const xml::Attributes& element);

// The first obstacle that a walker would run into on its track, or null.
[[nodiscard]] const Obstacle* obstacle_on_track(const Walker& walker, const WorldModel& world);

}  // namespace orca::sim::detail
