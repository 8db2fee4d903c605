// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/planning/ways.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/distance_transform.hpp"
#include "orca/navigation/grid_search.hpp"

namespace orca::planning {
using nav::Beam;
using nav::Cell;
using nav::DistanceTransform;
using nav::FloorGrid;
using nav::GridSearch;
using nav::kPlainCost;
using nav::kShortest;
using nav::Lattice;

namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();
constexpr std::size_t kNoPoint = std::numeric_limits<std::size_t>::max();

// A point as the search has come to it, from one of its sides. Its number is 2 * point + side.
struct WayLabel {
  double cost = kNoWay;    // from the start, with its toll
  std::size_t number = 0;  // of points on the way to it
  std::size_t before = kNoPoint;

  [[nodiscard]] bool is_better_than(const WayLabel& other) const {
    return cost < other.cost || (cost == other.cost && number < other.number);
  }
};

class WaySearch {
 public:
  WaySearch(const Ways& ways, const WayTolls& tolls)
      : ways_(ways), tolls_(tolls), labels_(2 * ways.points.size()), legs_(ways.points.size()) {
    for (std::size_t i = 0; i < ways.legs.size(); ++i) {
      legs_[ways.legs[i].from].push_back({i, false});
      if (!ways.legs[i].one_way) legs_[ways.legs[i].to].push_back({i, true});
    }
  }

  std::optional<FoundWay> run() {
    for (std::size_t i = 0; i < labels_.size(); ++i)
      if (is_door(i / 2) || i % 2 == 0) offer(i, {tolls_.from_start[i] + tolls_.points[i / 2], 1, kNoPoint});
    while (!open_.empty()) {
      const auto [cost, number, at] = open_.top();
      open_.pop();
      if (cost != labels_[at].cost || number != labels_[at].number) continue;
      for (const Turn& leg : legs_[at / 2]) follow(at, leg);
    }
    return way_to(best_end());
  }

 private:
  using Entry = std::tuple<double, std::size_t, std::size_t>;  // cost, number of points, label
  struct Turn {
    std::size_t leg;
    bool back;  // Whether it is driven from its end to its beginning.
  };

  [[nodiscard]] bool is_door(std::size_t point) const { return ways_.points[point].door.has_value(); }
  // Returns the side on which a way goes on that has come to a point from one of its sides.
  [[nodiscard]] std::size_t way_out(std::size_t label) const {
    return is_door(label / 2) ? 1 - label % 2 : 0;
  }

  void offer(std::size_t at, const WayLabel& label) {
    if (label.cost == kNoWay || !label.is_better_than(labels_[at])) return;
    labels_[at] = label;
    open_.emplace(label.cost, label.number, at);
  }

  void follow(std::size_t at, const Turn& turn) {
    const WayLeg& leg = ways_.legs[turn.leg];
    if ((turn.back ? leg.to_side : leg.from_side) != way_out(at)) return;
    const std::size_t next = turn.back ? leg.from : leg.to;
    const std::size_t side = turn.back ? leg.from_side : leg.to_side;
    offer(2 * next + side, {labels_[at].cost + leg.cost + tolls_.legs[turn.leg] + tolls_.points[next],
                            labels_[at].number + 1, at});
  }

  [[nodiscard]] WayLabel best_end() const {
    WayLabel best;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const WayLabel end{labels_[i].cost + tolls_.to_goal[i - i % 2 + way_out(i)], labels_[i].number, i};
      if (end.cost < kNoWay && end.is_better_than(best)) best = end;
    }
    return best;
  }

  [[nodiscard]] std::optional<FoundWay> way_to(const WayLabel& end) const {
    if (end.cost == kNoWay) return std::nullopt;
    FoundWay way{{}, {}, end.cost};
    for (std::size_t at = end.before; at != kNoPoint; at = labels_[at].before) {
      const std::size_t before = labels_[at].before;
      way.points.push_back(at / 2);
      way.costs.push_back(labels_[at].cost - (before == kNoPoint ? 0.0 : labels_[before].cost));
    }
    std::ranges::reverse(way.points);
    std::ranges::reverse(way.costs);
    return way;
  }

  const Ways& ways_;
  const WayTolls& tolls_;
  std::vector<WayLabel> labels_;
  std::vector<std::vector<Turn>> legs_;  // of each point
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

Vec2 beside(const WayPoint& door, double along, double across) {
  return Pose2{door.place.x, door.place.y, door.door->direction} * Vec2{along, across};
}

// Calls `visit(cell)` for the cells of a rectangle around a door, along its axis and across.
template <typename Visit>
void for_cells_of(const Lattice& lattice, const WayPoint& door, double half_along, double half_across,
                  Visit visit) {
  const double step = 0.5 * lattice.side;
  for (double along = -half_along; along <= half_along + 1e-9; along += step)
    for (double across = -half_across; across <= half_across + 1e-9; across += step)
      if (const Cell cell = lattice.cell_at(beside(door, along, across)); lattice.holds(cell)) visit(cell);
}

constexpr double kKeepOff = 0.15;  // [m]
constexpr double kOwnRoom = 0.4;   // [m]
constexpr double kInDoor = 0.5;    // [m]
constexpr double kAside = 0.15;    // [m]  beside a doorway, where a wall is

// Returns the costs of the cells of a map that is cut at its doors.
std::vector<std::uint16_t> cut_costs(const FloorGrid& grid, const Ways& ways, Vec2 place) {
  const Lattice& lattice = grid.lattice;
  std::vector<std::uint8_t> obstacles(lattice.size());
  for (std::size_t i = 0; i < obstacles.size(); ++i) obstacles[i] = grid.free(lattice.cell_of(i)) ? 0 : 1;
  const int reach = static_cast<int>(std::ceil(kKeepOff / lattice.side)) + 1;
  DistanceTransform transform;
  const auto squared = transform(obstacles, lattice.columns, lattice.rows, reach);
  const double near = kKeepOff / lattice.side;
  std::vector<std::uint16_t> costs(lattice.size());
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const bool is_own = norm(lattice.middle_of(lattice.cell_of(i)) - place) < kOwnRoom;
    const bool is_passable = obstacles[i] == 0 && (is_own || squared[i] > near * near);
    costs[i] = is_passable ? kPlainCost : 0;
  }
  for (const WayPoint& point : ways.points)
    if (point.door && norm(point.place - place) > kInDoor)
      for_cells_of(lattice, point, lattice.side, 0.5 * point.door->width + kAside,
                   [&](Cell cell) { costs[lattice.index(cell)] = 0; });
  return costs;
}

// Returns the least cost of those cells around a place [m] that `counts(middle of the cell)`.
template <typename Counts>
double cost_around(const GridSearch& search, const Lattice& lattice, Vec2 place, Counts counts) {
  constexpr double kAround = 0.15;  // [m], but at least a cell
  const int around = std::max(1, static_cast<int>(std::lround(kAround / lattice.side)));
  const Cell middle = lattice.cell_at(place);
  std::uint32_t least = UINT32_MAX;
  for (int row = -around; row <= around; ++row)
    for (int column = -around; column <= around; ++column)
      if (const Cell cell{middle.column + column, middle.row + row};
          lattice.holds(cell) && counts(lattice.middle_of(cell)))
        least = std::min(least, search.cost_from(lattice.index(cell)));
  if (least == UINT32_MAX) return kNoWay;
  return lattice.side * least / (static_cast<double>(kShortest.straight) * kPlainCost);
}

// Returns the cost of a door on one of its sides: 1 where its direction points, otherwise 0. Large cells lie on both sides of it.
double cost_beside(const GridSearch& search, const Lattice& lattice, const WayPoint& door, int side) {
  const double sign = side == 1 ? 1.0 : -1.0;
  const Pose2 X_MD{door.place.x, door.place.y, door.door->direction};
  const auto is_on_side = [&](Vec2 middle) { return sign * seen_from(X_MD, middle).x > 0.0; };
  return kInDoor + cost_around(search, lattice, beside(door, sign * kInDoor, 0.0), is_on_side);
}

}  // namespace

std::optional<std::size_t> Ways::find(std::string_view point) const {
  const auto found = std::ranges::find(points, point, &WayPoint::name);
  if (found == points.end()) return std::nullopt;
  return static_cast<std::size_t>(found - points.begin());
}

std::optional<FoundWay> cheapest_way(const Ways& ways, const WayTolls& tolls) {
  return WaySearch(ways, tolls).run();
}

std::size_t side_of(const WayPoint& point, std::string_view room) {
  return point.door && point.rooms[1] == room ? 1 : 0;
}

std::vector<double> costs_from(const FloorGrid& grid, const Ways& ways, Vec2 place) {
  std::vector<double> result(2 * ways.points.size(), kNoWay);
  const Cell start = grid.lattice.cell_at(place);
  if (!grid.lattice.holds(start)) return result;
  const std::vector<std::uint16_t> costs = cut_costs(grid, ways, place);
  GridSearch search(kShortest);
  search.flood(grid.lattice, costs, start, start, UINT32_MAX);
  for (std::size_t i = 0; i < ways.points.size(); ++i) {
    const WayPoint& point = ways.points[i];
    if (!point.door) {
      result[2 * i] = cost_around(search, grid.lattice, point.place, [](Vec2) { return true; });
    } else if (norm(point.place - place) <= kInDoor) {
      result[2 * i] = result[2 * i + 1] = norm(point.place - place);
    } else {
      result[2 * i] = cost_beside(search, grid.lattice, point, 0);
      result[2 * i + 1] = cost_beside(search, grid.lattice, point, 1);
    }
  }
  return result;
}

std::optional<bool> DoorView::is_open(double width) const {
  constexpr int kFewest = 5;
  constexpr double kPart = 0.35;  // of its width that must be seen
  if (through + stopped < kFewest || extent < kPart * width) return std::nullopt;
  return through >= stopped;
}

DoorView look_at(const WayPoint& door, std::span<const Beam> beams) {
  constexpr double kDepth = 0.15;    // [m] before and behind its middle: leaf, wall and an error of the pose
  constexpr double kSteepest = 0.5;  // cosine of 60 degrees
  constexpr double kMiddle = 0.35;   // of the width, to both sides of its middle
  const Pose2 X_WD{door.place.x, door.place.y, door.door->direction};
  DoorView view;
  double low = kNoWay, high = -kNoWay;
  for (const Beam& beam : beams) {
    const Vec2 from = seen_from(X_WD, beam.from);
    const Vec2 to = seen_from(X_WD, beam.to);
    const Vec2 way = to - from;
    if (std::fabs(way.x) < kSteepest * norm(way)) continue;
    const double side = from.x < 0.0 ? 1.0 : -1.0;
    const bool leads_through = side * to.x > kDepth;
    const bool ends_in_it = beam.echo && std::fabs(to.x) <= kDepth;
    if (std::fabs(from.x) <= kDepth || (!leads_through && !ends_in_it)) continue;
    const double across = from.y - from.x * way.y / way.x;
    if (std::fabs(across) > kMiddle * door.door->width) continue;
    ++(leads_through ? view.through : view.stopped);
    low = std::min(low, across);
    high = std::max(high, across);
  }
  view.extent = std::max(0.0, high - low);
  return view;
}

}  // namespace orca::planning
