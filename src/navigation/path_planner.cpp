// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/path_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/navigation/gaps.hpp"

namespace orca::nav {
namespace {

constexpr double kSlack = 0.4;       // [cells] by which cells make obstacles appear nearer than they are
constexpr double kTight = 0.04;      // [m] beside the inner circle: only if there is no other way
constexpr double kTightCost = 10.0;  // [1] extra cost there
constexpr std::uint16_t kEscapeCost = 20 * kPlainCost;  // of leaving a place that is too near to something
constexpr double kSpacing = 0.1;                        // [m] of the points of a path
constexpr int kRounds = 12;                             // of rounding
constexpr double kLookEvery = 0.05;                     // [m] at which the outline is tried along a path
constexpr double kOwnPlace =
    0.25;  // [m] of the path from the start, where the robot's real heading counts, not the path's
constexpr double kSure =
    3.0;  // [m] of the path from the start; what is farther away is not seen well enough to close a way
constexpr double kTouching = 0.005;  // [m] clearance that counts as a touch
constexpr double kClosed = 0.11;     // [m] radius of a place that is closed
constexpr int kTries = 6;

std::uint16_t as_cost(double extra) {
  return static_cast<std::uint16_t>(std::lround((1.0 + extra) * kPlainCost));
}

// Returns the goal, or where the straight line to it leaves the lattice.
Cell goal_within(const Lattice& lattice, Vec2 start, Vec2 goal) {
  Cell last = lattice.cell_at(start);
  const Vec2 way = shortened(goal - start, lattice.side * (lattice.columns + lattice.rows));
  walk_line(lattice, start, start + way, [&](Cell cell) {
    if (!lattice.holds(cell)) return false;
    last = cell;
    return true;
  });
  return last;
}

bool touches(const OccupancyMap& map, const Footprint& footprint, const Path& path, double along) {
  const Vec2 place = path.at(along);
  const Vec2 axis = direction(path.heading(along));
  bool touches = false;
  map.for_points_near(place, footprint.outer_radius(), [&](Vec2 point) {
    const Vec2 way = point - place;
    touches = touches || clearance(footprint, Vec2{dot(axis, way), cross(axis, way)}) < kTouching;
  });
  return touches;
}

}  // namespace

double touches_along(const OccupancyMap& map, const Footprint& footprint, const Path& path, double from,
                     double to) {
  for (double along = from; along < std::min(to, path.length()); along += 2.0 * kLookEvery)
    if (touches(map, footprint, path, along)) return along;
  return -1.0;
}

void PathPlanner::look_at(const OccupancyMap& map, const Footprint& footprint, const PlanWishes& wishes) {
  const Lattice& lattice = map.lattice();
  footprint_ = footprint;
  obstacles_.resize(lattice.size());
  for (std::size_t i = 0; i < obstacles_.size(); ++i) obstacles_[i] = map.occupied(i) ? 1 : 0;

  const double inner = footprint.inner_radius();
  const double comfort = inner + wishes.clearance;
  const double outer = std::max(comfort, footprint.outer_radius() + 0.1);
  const int reach = static_cast<int>(std::ceil(outer / lattice.side)) + 1;
  distances_ = transform_(obstacles_, lattice.columns, lattice.rows, reach);

  cost_by_distance_.assign(static_cast<std::size_t>(reach * reach) + 1, kPlainCost);
  for (std::size_t i = 0; i < cost_by_distance_.size(); ++i) {
    const double distance = std::sqrt(static_cast<double>(i)) * lattice.side;
    const double lack = std::clamp((comfort - distance) / (comfort - inner), 0.0, 1.0);
    const double tight = distance < inner + kTight ? kTightCost : 0.0;
    cost_by_distance_[i] = as_cost(wishes.clearance_cost * lack * lack + tight);
    if (distance < inner - kSlack * lattice.side) cost_by_distance_[i] = 0;
  }
  costs_.resize(lattice.size());
  forbidden_.clear();
  const std::uint16_t unknown = as_cost(wishes.unknown_cost) - kPlainCost;
  for (std::size_t i = 0; i < costs_.size(); ++i) {
    const std::uint16_t cost = cost_at(distances_[i]);
    costs_[i] = cost == 0 || map.known(i) ? cost : static_cast<std::uint16_t>(cost + unknown);
  }
}

void PathPlanner::obey(const Lattice& lattice, const FloorRules& rules, Vec2 robot) {
  rules.apply(lattice, robot, costs_);
  forbidden_ = rules.forbidden(lattice);
}

std::uint16_t PathPlanner::cost_at(std::int32_t squared_distance) const {
  const auto index = static_cast<std::size_t>(squared_distance);
  return index < cost_by_distance_.size() ? cost_by_distance_[index] : kPlainCost;
}

Plan PathPlanner::plan(const OccupancyMap& map, Vec2 start, Vec2 goal) {
  const Lattice& lattice = map.lattice();
  const Cell from = lattice.cell_at(start);
  const Cell to = goal_within(lattice, start, goal);
  open_around(map, from);
  for (int attempt = 1;; ++attempt) {
    const CellWay way = search_(lattice, costs_, from, to, forbidden_);
    std::vector<Vec2> line = straightened(lattice, costs_, way, forbidden_);
    line.front() = start;
    const bool complete = way.complete && to == lattice.cell_at(goal);
    if (complete) line.back() = goal;
    Plan plan{lined_up(map, footprint_, rounded(lattice, costs_, line, kSpacing, kRounds, forbidden_)), 0.0,
              complete};
    const double touch = first_touch(map, plan.path, kOwnPlace);
    if (touch < 0.0 || attempt == kTries) {
      plan.complete = plan.complete && touch < 0.0;
      plan.cost = cost_of(map, plan.path, 0.0);
      return plan;
    }
    close(lattice, plan.path.at(touch));
  }
}

// The robot may stand nearer to something than its inner circle allows. It must find a way from there, on which it gets no nearer.
void PathPlanner::open_around(const OccupancyMap& map, Cell start) {
  const Lattice& lattice = map.lattice();
  const int reach = static_cast<int>(std::ceil(footprint_.inner_radius() / lattice.side));
  for (int row = start.row - reach; row <= start.row + reach; ++row)
    for (int column = start.column - reach; column <= start.column + reach; ++column) {
      const Cell cell{column, row};
      if (!lattice.holds(cell) || costs_[lattice.index(cell)] != 0 || map.occupied(cell)) continue;
      const bool is_near =
          distances_[lattice.index(cell)] <
          footprint_.inner_radius() * footprint_.inner_radius() / (lattice.side * lattice.side);
      if (is_near && distances_[lattice.index(cell)] >= distances_[lattice.index(start)])
        costs_[lattice.index(cell)] = kEscapeCost;
    }
}

double PathPlanner::first_touch(const OccupancyMap& map, const Path& path, double from) const {
  const Lattice& lattice = map.lattice();
  const double sure = (footprint_.outer_radius() + lattice.side) / lattice.side;
  for (double along = from; along < std::min(from + kSure, path.length()); along += kLookEvery) {
    const Cell cell = lattice.cell_at(path.at(along));
    if (!lattice.holds(cell) || distances_[lattice.index(cell)] > sure * sure) continue;
    if (touches(map, footprint_, path, along)) return along;
  }
  return -1.0;
}

void PathPlanner::close(const Lattice& lattice, Vec2 place) {
  const int reach = static_cast<int>(std::ceil(kClosed / lattice.side));
  const Cell middle = lattice.cell_at(place);
  for (int row = middle.row - reach; row <= middle.row + reach; ++row)
    for (int column = middle.column - reach; column <= middle.column + reach; ++column)
      if (lattice.holds({column, row}) && norm(lattice.middle_of({column, row}) - place) <= kClosed)
        costs_[lattice.index({column, row})] = 0;
}

double PathPlanner::cost_of(const OccupancyMap& map, const Path& path, double from) const {
  const Lattice& lattice = map.lattice();
  double sum = 0.0;
  Vec2 before = path.at(from);
  for (double along = from; along < path.length();) {
    along = std::min(along + kSpacing, path.length());
    const Vec2 next = path.at(along);
    const double cost = cost_of_line(lattice, costs_, before, next);
    // The first steps may lead out of a place that is too near to something.
    if (cost >= kImpassable && along - from > kOwnPlace) return kImpassable;
    sum += cost < kImpassable ? cost : kEscapeCost;
    before = next;
  }
  return first_touch(map, path, from + kOwnPlace) < 0.0 ? sum : kImpassable;
}

bool KeptPlan::renew(const Facts& facts) {
  constexpr double kBetter = 0.92;  // A new path must cost less than that share of the old one.
  planner_.look_at(facts.map, facts.footprint, facts.wishes);
  if (facts.rules != nullptr) planner_.obey(facts.map.lattice(), *facts.rules, facts.robot);
  Plan plan = planner_.plan(facts.map, facts.robot, facts.place);
  const bool keeps = !plan_.path.empty() && plan_.complete && !facts.blocked &&
                     norm(plan_.path.at(facts.along) - facts.robot) < kAside &&
                     plan.cost > kBetter * planner_.cost_of(facts.map, plan_.path, facts.along) &&
                     !runs_beside(plan.path, facts.along);
  if (!keeps) plan_ = std::move(plan);
  return !keeps;
}

// Returns whether a path goes the same way as the present one, from a place on that, for some time: then it is only newer.
bool KeptPlan::runs_beside(const Path& path, double along) const {
  constexpr double kWay = 0.1;      // [m] at which they are compared
  constexpr double kSameWay = 2.5;  // [m] ahead, as far as
  constexpr double kBeside = 0.25;  // [m] apart: the same way
  for (double way = 0.0; way < kSameWay; way += kWay) {
    const Vec2 place = path.at(way);
    const double nearest = plan_.path.nearest(place, along, std::min(along + way + 1.0, plan_.path.length()));
    if (norm(plan_.path.at(nearest) - place) > kBeside) return false;
  }
  return true;
}

}  // namespace orca::nav
