// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <vector>

#include "orca/avoidance/laser_avoider.hpp"

namespace {

/// An avoid behaviour that keeps the robot from driving into what its laser sees (thesis 11.1). See
/// README.md.
class LaserAvoid final : public orca::avoid::LaserAvoider {
 public:
  explicit LaserAvoid(orca::ComponentHost& host) : LaserAvoider(host, {.shapes = true}) {}

 private:
  orca::avoid::Advice advice(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
                             const orca::avoid::Limits& limits) override {
    orca::avoid::Limits mine = limits;
    mine.turn_margin = kTurnMargin;
    mine.watches_goal = true;
    seen_.assign(memory.echoes().begin(), memory.echoes().end());
    orca::avoid::add_feet(seen_, std::max(0.0, kFromAlone - limits.margin));
    mine = with_body(seen_, situation, mine);
    return avoid(seen_, situation, mine);
  }

  // [m] Less than others keep: it knows the shape of what is near.
  static constexpr double kTurnMargin = 0.02;
  // [m] Kept free beside what stands alone, unless the margin is more. The body of a Create 2 is 0.13 m wider to each side than the head
  // of its laser.
  static constexpr double kFromAlone = 0.22;

  std::vector<orca::Vec2> seen_;
};

}  // namespace

ORCA_COMPONENT(LaserAvoid, "orca.LaserAvoid")
