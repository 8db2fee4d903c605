// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <utility>

#include "orca/component.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/navigation/occupancy_map.hpp"

namespace orca::planner {

/// The port by which a plan leads another behaviour, which drives in the planner's stead.
///
/// Thread contract: as the component that owns it.
class Lead {
 public:
  explicit Lead(Component& owner)
      : port_(owner, "AheadPush",
              {.text = "The place on its path that is look_ahead_time ahead, once per lap while a path leads "
                       "on: for an avoid behaviour that drives in its stead."}) {}

  /// Names the place to drive to, in the frame of the goals. Within `reach_radius` [m] of it the other behaviour leaves
  /// coming to rest to the planner; 0: it is only passed.
  void name(Vec2 place, double reach_radius) {
    if (port_.subscriber_count() == 0) return;
    auto point = port_.loan();
    point->coordinate().point().x(place.x);
    point->coordinate().point().y(place.y);
    point->reach_radius().distance(reach_radius);
    point->via(reach_radius == 0.0);
    port_.push(std::move(point));
  }

 private:
  PushServer<idl::GoalPoint> port_;
};

/// The port by which a planner shows what it has seen, to people and recordings.
///
/// Thread contract: as the component that owns it.
class ShownMap {
 public:
  explicit ShownMap(Component& owner)
      : port_(owner, "MapPush",
              {.text =
                   "The map by which it plans, in the frame of the goals, once a second while it drives and "
                   "somebody takes it."}) {}

  void show(const nav::OccupancyMap& map, TimePoint now) {
    if (port_.subscriber_count() == 0 || now < due_) return;
    constexpr Duration kPeriod = std::chrono::seconds(1);
    due_ = now + kPeriod;
    auto grid = port_.loan();
    fill(map, *grid);
    port_.push(std::move(grid));
  }

 private:
  static void fill(const nav::OccupancyMap& map, idl::OccupancyGrid& grid) {
    constexpr std::uint8_t kFree = 0;
    constexpr std::uint8_t kOccupied = 100;
    constexpr std::uint8_t kUnknown = 255;
    const nav::Lattice& lattice = map.lattice();
    grid.corner().x(lattice.corner.x);
    grid.corner().y(lattice.corner.y);
    grid.resolution(lattice.side);
    grid.columns(static_cast<std::uint32_t>(lattice.columns));
    grid.rows(static_cast<std::uint32_t>(lattice.rows));
    grid.cells().resize(lattice.size());
    for (std::size_t i = 0; i < lattice.size(); ++i)
      grid.cells()[i] = map.occupied(i) ? kOccupied : map.known(i) ? kFree : kUnknown;
  }

  PushServer<idl::OccupancyGrid> port_;
  TimePoint due_{};
};

/// The ports by which a planner lets others see what it plans.
struct Outlook {
  explicit Outlook(Component& owner) : lead(owner), map(owner) {}
  Lead lead;
  ShownMap map;
};

}  // namespace orca::planner
