// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/idl/world.hpp"
#include "orca/sim/world.hpp"

namespace orca::sim {

/// Fills in what never moves.
void fill(idl::WorldPlan& plan, const WorldModel& model);
/// Fills in the robots, the people and what stands there, as they are now; neither stamp nor events.
void fill(idl::WorldScene& scene, const World& world);

/// Changes a world now.
/// @return what has changed, for people.
/// @errors  as hw::Surroundings::change().
Result<std::string> carry_out(const idl::WorldChange& change, World& world);

}  // namespace orca::sim
