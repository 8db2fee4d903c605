// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/floor_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "orca/navigation/grid_search.hpp"

namespace orca::nav {
namespace {

constexpr std::uint16_t kDear = 20 * kPlainCost;  // of a cell to keep out of, where the robot is
constexpr double kUsualSpeed = 0.5;               // [m/s]
constexpr double kMostTimes = 10.0;               // a slow zone costs at most so much more
constexpr double kAgainst = -0.1;  // cosine with the lane of a direction that is driven against it

// In the order of GridSearch.
constexpr double kHalf = 0.70710678118654752;
constexpr std::array<Vec2, 8> kWays{{{1.0, 0.0},
                                     {0.0, 1.0},
                                     {-1.0, 0.0},
                                     {0.0, -1.0},
                                     {kHalf, kHalf},
                                     {-kHalf, kHalf},
                                     {-kHalf, -kHalf},
                                     {kHalf, -kHalf}}};

// Calls `visit(index)` for the cells whose middles a zone holds.
template <typename Visit>
void for_cells_of(const FloorZone& zone, const Lattice& lattice, Visit visit) {
  const double reach = norm({zone.half_length, zone.half_width});
  const Cell low = lattice.cell_at(zone.middle.position() - Vec2{reach, reach});
  const Cell high = lattice.cell_at(zone.middle.position() + Vec2{reach, reach});
  for (int row = std::max(low.row, 0); row <= std::min(high.row, lattice.rows - 1); ++row)
    for (int column = std::max(low.column, 0); column <= std::min(high.column, lattice.columns - 1); ++column)
      if (zone.holds(lattice.middle_of({column, row}))) visit(lattice.index({column, row}));
}

}  // namespace

bool FloorZone::holds(Vec2 place) const {
  const Vec2 seen = seen_from(middle, place);
  return std::fabs(seen.x) <= half_length && std::fabs(seen.y) <= half_width;
}

std::uint8_t direction_bit(Vec2 direction) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < kWays.size(); ++i)
    if (dot(kWays[i], direction) > dot(kWays[best], direction)) best = i;
  return static_cast<std::uint8_t>(1U << best);
}

FloorRules FloorRules::in(const Pose2& X_AB) const {
  std::vector<FloorZone> zones = zones_;
  for (FloorZone& zone : zones) zone.middle = X_AB * zone.middle;
  return FloorRules(zones);
}

std::optional<double> FloorRules::speed_at(Vec2 place) const {
  std::optional<double> least;
  for (const FloorZone& zone : zones_)
    if (zone.kind == FloorZone::Kind::slow && zone.holds(place))
      least = std::min(least.value_or(zone.speed), zone.speed);
  return least;
}

void FloorRules::apply(const Lattice& lattice, Vec2 robot, std::span<std::uint16_t> costs) const {
  std::vector<bool> in_lane;
  for (const FloorZone& zone : zones_)
    if (zone.kind == FloorZone::Kind::lane) {
      in_lane.resize(lattice.size());
      for_cells_of(zone, lattice, [&](std::size_t index) { in_lane[index] = true; });
    }
  for (std::size_t i = 0; i < in_lane.size(); ++i)
    if (!in_lane[i] && costs[i] != 0) costs[i] = static_cast<std::uint16_t>(costs[i] + kPlainCost);
  for (const FloorZone& zone : zones_) {
    const double times = std::clamp(kUsualSpeed / std::max(zone.speed, 0.01) - 1.0, 0.0, kMostTimes);
    const auto slower = static_cast<std::uint16_t>(std::lround(times * kPlainCost));
    const bool is_here = zone.holds(robot);
    for_cells_of(zone, lattice, [&](std::size_t index) {
      if (costs[index] == 0) return;
      if (zone.kind == FloorZone::Kind::keep_out) costs[index] = is_here ? kDear : std::uint16_t{0};
      if (zone.kind == FloorZone::Kind::slow)
        costs[index] = static_cast<std::uint16_t>(costs[index] + slower);
    });
  }
}

std::vector<std::uint8_t> FloorRules::forbidden(const Lattice& lattice) const {
  std::vector<std::uint8_t> bits;
  for (const FloorZone& zone : zones_) {
    if (zone.kind != FloorZone::Kind::lane || !zone.one_way) continue;
    bits.resize(lattice.size());
    std::uint8_t against = 0;
    for (const Vec2 way : kWays)
      if (dot(way, direction(zone.middle.yaw)) < kAgainst) against |= direction_bit(way);
    for_cells_of(zone, lattice, [&](std::size_t index) { bits[index] |= against; });
  }
  return bits;
}

}  // namespace orca::nav
