// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

// The track of a walker: its place as a function of the time for which it has walked.
class WalkerTrack {
 public:
  // @pre  the track has two corners and a length, the speed is positive.
  WalkerTrack(const Walker& walker, std::uint64_t run_seed);

  struct Place {
    Vec2 position;
    Vec2 ahead;  // Unit vector along the leg.
  };
  [[nodiscard]] Place at(Duration walked) const;

 private:
  struct Leg {
    Vec2 from, to;
    Duration begin, walk;  // After `walk`, the walker waits at `to` until the next leg begins.
  };
  void add_leg(const Walker& walker, Vec2 from, Vec2 to, Duration rest);

  std::vector<Leg> legs_;
  Duration period_{0};
  Duration phase_{0};
};

}  // namespace orca::sim::detail
