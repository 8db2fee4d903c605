// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "orca/navigation/distance_transform.hpp"
#include "orca/navigation/floor_rules.hpp"
#include "orca/navigation/footprint.hpp"
#include "orca/navigation/grid_search.hpp"
#include "orca/navigation/occupancy_map.hpp"
#include "orca/navigation/path.hpp"

namespace orca::nav {

/// The preferences of a planner.
struct PlanWishes {
  double clearance = 0.35;  ///< [m] beside the robot's inner circle; nearer to obstacles a way gets dearer.
  double clearance_cost = 4.0;  ///< [1] extra cost of a way right beside an obstacle, relative to a free one.
  double unknown_cost = 0.5;    ///< [1] extra cost of a way through cells that have not been seen.
};

/// A planned way.
struct Plan {
  Path path;              ///< from the robot to the goal, map frame.
  double cost = 0.0;      ///< of the path, comparable with PathPlanner::cost_of().
  bool complete = false;  ///< whether it leads to the goal, not only as near to it as possible.

  /// Names what it consists of.
  [[nodiscard]] auto state() { return std::tie(path, cost, complete); }
};

/// Returns where the outline, driven along a path, first touches an obstacle of the map, in [from, to] [m]; negative: nowhere.
/// @thread  pure function; any thread.
[[nodiscard]] double touches_along(const OccupancyMap& map, const Footprint& footprint, const Path& path,
                                   double from, double to);

/// A planner of ways through an occupancy map. Cells nearer to an obstacle than the robot's inner circle are not passable. Where
/// the circle cannot decide, the exact outline does: if it would touch something on the first 3 m of the way, the
/// place is closed and the search is repeated. Farther away a sensor's noise could close a way that is open. It keeps its buffers from call to call.
///
/// Thread contract: one thread at a time.
class PathPlanner {
 public:
  explicit PathPlanner(SearchRules rules = {}) : search_(rules) {}

  /// Computes distances and costs again from the map.
  void look_at(const OccupancyMap& map, const Footprint& footprint, const PlanWishes& wishes);

  /// Takes account of rules that no sensor sees, until the next look_at().
  /// @param robot  map frame, as the rules.
  void obey(const Lattice& lattice, const FloorRules& rules, Vec2 robot);

  /// Plans a way. A goal outside of the map counts as the place of the map on the straight line to it.
  /// @pre  look_at() has been called with this map since it changed; the map holds `start`.
  [[nodiscard]] Plan plan(const OccupancyMap& map, Vec2 start, Vec2 goal);

  /// Returns the cost of the part of a path from `from` [m] on, as the costs are now; kImpassable if it leads through a cell
  /// that is not passable, or if the outline would touch something on the first 3 m of it.
  [[nodiscard]] double cost_of(const OccupancyMap& map, const Path& path, double from) const;

  /// Returns the costs of the cells, as look_at() has found them, for GridSearch. plan() changes those near the start, and in places where
  /// the outline would touch something.
  [[nodiscard]] std::span<const std::uint16_t> costs() const { return costs_; }
  /// Returns the directions in which no step may lead, for GridSearch.
  [[nodiscard]] std::span<const std::uint8_t> forbidden() const { return forbidden_; }

 private:
  void open_around(const OccupancyMap& map, Cell start);
  [[nodiscard]] std::uint16_t cost_at(std::int32_t squared_distance) const;
  /// Returns where the outline first touches something [m], beyond `from`; negative: nowhere.
  [[nodiscard]] double first_touch(const OccupancyMap& map, const Path& path, double from) const;
  void close(const Lattice& lattice, Vec2 place);

  DistanceTransform transform_;
  GridSearch search_;
  Footprint footprint_;
  std::vector<std::uint8_t> obstacles_;
  std::vector<std::uint16_t> costs_;
  std::vector<std::uint8_t> forbidden_;
  std::vector<std::uint16_t> cost_by_distance_;  // squared, in cells
  std::span<const std::int32_t> distances_;      // squared, in cells
};

/// A plan that is kept as long as no other one is clearly better.
///
/// Thread contract: one thread at a time.
class KeptPlan {
 public:
  explicit KeptPlan(SearchRules rules = {}) : planner_(rules) {}

  /// The facts by which it is planned.
  struct Facts {
    const OccupancyMap& map;
    const Footprint& footprint;
    const PlanWishes& wishes;
    Vec2 robot;                         ///< map frame, as the next.
    Vec2 place;                         ///< to plan for.
    double along = 0.0;                 ///< [m] place of the robot on the present path.
    bool blocked = false;               ///< The present path leads nowhere.
    const FloorRules* rules = nullptr;  ///< null: there are none.
  };
  /// Plans. The new plan replaces the present one if that one is not complete, leads nowhere, or lies aside of the robot, or if the new one is 8 % cheaper and
  /// leads another way.
  /// @return whether it did.
  bool renew(const Facts& facts);

  [[nodiscard]] const Plan& plan() const { return plan_; }
  void drop() { plan_ = {}; }
  /// Names what it knows.
  [[nodiscard]] auto state() { return std::tie(plan_); }

  static constexpr double kAside = 0.5;  ///< [m] off the path: it is of no use.

 private:
  [[nodiscard]] bool runs_beside(const Path& path, double along) const;

  PathPlanner planner_;
  Plan plan_;
};

}  // namespace orca::nav
