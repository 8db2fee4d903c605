// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/grid_search.hpp"
#include "orca/navigation/outline_grid.hpp"
#include "orca/navigation/reeds_shepp.hpp"

namespace orca::nav {

/// A goal of a robot that steers.
struct SteeredGoal {
  Vec2 place;                 ///< map frame.
  std::optional<double> yaw;  ///< [rad] if it must have it there.
};

/// A way of a robot that steers, from where it is.
struct SteeredPlan {
  std::vector<WayPiece> pieces;
  bool complete = false;  ///< whether it leads to the goal, not only as near to it as was found.
};

/// A planner for robots that cannot turn on the spot, or not without room: it searches arcs and straight lines, forwards and backwards, of a
/// robot that drives no smaller circle than one of a given radius, tried with the exact outline against whole cells.
///
/// States are cells with one of 72 headings, counted from the heading at the start; each holds the cheapest true pose that came to it. The estimate of what is left is the cost of
/// the cheapest way through the cells, and near the goal the shortest way without obstacles if that is longer. Now and then, the nearer
/// to the goal the more often, that shortest way is tried as the end of the plan. In the end parts of the plan are replaced by
/// shortest ways as far as these are free. The plan is good, not the best one.
///
/// Thread contract: one thread at a time.
/// @source  Dolgov, Thrun, Montemerlo and Diebel, "Practical search techniques in path planning for autonomous driving", AAAI workshop STAIR
///          2008. Not taken over: Voronoi field (the costs of cells stand for it) and smoothing by gradients.
class HybridPlanner {
 public:
  /// Takes over a map.
  /// @param costs   of the cells, for GridSearch; see PathPlanner::costs().
  /// @param forbidden  directions in which nobody may drive, for GridSearch; none: all are allowed.
  /// @param radius [m]  of the smallest circle that the robot drives.  @param margin [m]  kept free around the outline; from 1.5 cm on the
  ///                outline is free on all of the way, not only where it is tried.
  void look_at(const OccupancyMap& map, const Footprint& footprint, std::span<const std::uint16_t> costs,
               std::span<const std::uint8_t> forbidden, double radius, double margin);

  /// Plans a way. A robot whose outline touches something may leave that place, but never touch more.
  [[nodiscard]] SteeredPlan plan(const Pose2& start, const SteeredGoal& goal);

  [[nodiscard]] const OutlineGrid& outline() const { return outline_; }
  /// Returns how many states the last plan() looked at.
  [[nodiscard]] std::size_t visited() const { return visited_; }

 private:
  // A short piece, and the poses on it as seen from its start.
  struct Primitive {
    WayPiece piece;
    std::vector<Pose2> steps;
  };
  struct Node {
    Pose2 pose;
    double cost = 0.0;  // [m] so far
    std::uint32_t parent = 0;
    std::uint32_t key = 0;
    WayPiece piece;  // that led here
    int touched = 0;
  };
  // A whole way: to a node, and from there to the goal.
  struct Candidate {
    std::uint32_t node;
    std::vector<WayPiece> end;
    double cost;
  };

  void begin(const Pose2& start, const SteeredGoal& goal);
  void search();
  void expand(std::uint32_t number);
  void add(Node node, double left);
  [[nodiscard]] std::optional<double> left_from(const Node& node) const;
  [[nodiscard]] bool drive(Node& node, const Primitive& primitive, Vec2 axis) const;
  [[nodiscard]] bool obeys(const Pose2& pose, double way, int touched) const;
  [[nodiscard]] bool may_drive(Pose2 pose, std::span<const WayPiece> way) const;
  void try_end(std::uint32_t number);
  [[nodiscard]] std::vector<WayPiece> end_from(const Pose2& pose) const;
  [[nodiscard]] double cost_of(const Pose2& from, const WayPiece& piece) const;
  [[nodiscard]] std::uint32_t* slot(std::uint32_t key);
  [[nodiscard]] std::vector<WayPiece> way_to(std::uint32_t number) const;
  [[nodiscard]] std::vector<WayPiece> shortened(const Pose2& start, const std::vector<WayPiece>& way) const;

  OutlineGrid outline_;
  GridSearch search_{kShortest};
  std::vector<std::uint16_t> costs_;
  std::vector<std::uint8_t> forbidden_;
  double radius_ = 1.0;
  std::vector<Primitive> primitives_;

  // These belong to one plan.
  SteeredGoal goal_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> table_;                       // number + 1 of the node of a state, by its key
  std::vector<std::pair<double, std::uint32_t>> waiting_;  // cost of the whole way, then the node
  std::optional<Candidate> best_;
  std::size_t visited_ = 0;
  std::size_t since_try_ = 0;
  std::size_t since_found_ = 0;
  std::pair<double, std::uint32_t> nearest_;  // what is left, the node
};

}  // namespace orca::nav
