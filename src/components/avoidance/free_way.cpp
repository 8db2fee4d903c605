// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/free_way.hpp"

namespace orca::avoid {

FreeWay::FreeWay(Component& owner)
    : side_distance_(
          owner, "side_distance", 0.2,
          {.unit = "m",
           .min = 0.0,
           .text = "An echo nearer to the robot's circle than this counts as a wall across its beam."}) {}

Advice FreeWay::advice(const EchoMemory& memory, const Situation& situation, Limits limits) const {
  limits.side_distance = limits.squeezes ? 0.0 : *side_distance_;
  return avoid(memory.echoes(), situation, limits);
}

}  // namespace orca::avoid
