// SPDX-License-Identifier: LGPL-3.0-or-later
#include "region.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "orca/geometry/angle.hpp"

namespace orca::nd {
namespace {

constexpr double kSameGap = 0.5;    // [rad] between where the robot went and the gap that it went to.
constexpr double kKept = 0.5;       // [rad] by which another gap must be nearer to the goal.
constexpr double kRounding = 1e-9;  // [m] The place beside an edge is a radius away from it.

// A region with the rising gap at one of its sides.
struct Entrance {
  Region region;
  double side;      // +1: its left side, -1: its right one.
  double off_goal;  // [rad] of the gap.
};

std::size_t inside(const Entrance& way) { return way.side > 0.0 ? way.region.left() : way.region.right; }

std::size_t outside(const Entrance& way) { return left_of(inside(way), way.side > 0.0 ? 1 : kSectors - 1); }

// The regions' entrances, the one nearest to the goal first.
std::vector<Entrance> entrances(const std::vector<Region>& regions, const Goal& goal) {
  std::vector<Entrance> found;
  for (const Region& region : regions) {
    if (region.rises_left) found.push_back({region, 1.0, 0.0});
    if (region.rises_right) found.push_back({region, -1.0, 0.0});
  }
  for (Entrance& way : found) {
    const double gap = direction_of(inside(way)) + 0.5 * way.side * kSector;
    way.off_goal = std::abs(wrapped(gap - goal.direction));
    if (goal.last && std::abs(wrapped(gap - *goal.last)) < kSameGap) way.off_goal -= kKept;
  }
  std::ranges::stable_sort(found, {}, &Entrance::off_goal);
  return found;
}

// Returns the outermost obstacle at a gap: an echo, since a sector is too coarse to pass it closely.
Vec2 edge_of(const Entrance& way, std::span<const Vec2> echoes, const Depths& seen, double radius) {
  const double depth = seen[outside(way)];
  const Vec2 sight = direction(direction_of(outside(way)));
  Vec2 edge = depth * sight;
  double outermost = -kSector;  // [rad], in effect
  for (const Vec2 echo : echoes) {
    const double away = norm(echo);
    const double in = -way.side * cross(sight, echo) / away;
    if (std::abs(away - depth) > 2.0 * radius || dot(sight, echo) <= 0.0 || in <= outermost || in > kSector)
      continue;
    edge = echo;
    outermost = in;
  }
  return edge;
}

// The robot passes an edge at a distance of its radius.
FreeWalkingArea area_at(const Entrance& way, std::span<const Vec2> echoes, const Depths& seen,
                        double radius) {
  const Edge edge{edge_of(way, echoes, seen, radius), way.side};
  const Vec2 sight = (1.0 / norm(edge.place)) * edge.place;
  return {way.region, edge.place + (edge.side * radius) * Vec2{sight.y, -sight.x}, edge};
}

// A goal that is seen where no region is, in front of a wall, has one of its own.
Region region_of(std::size_t sector, const std::vector<Region>& regions) {
  const auto holds = [&](const Region& region) { return region.holds(sector); };
  const auto found = std::ranges::find_if(regions, holds);
  return found != regions.end() ? *found : Region{sector, 1};
}

}  // namespace

FreeWalkingArea seen_from(const Pose2& X_RB, FreeWalkingArea area) {
  area.region.right = left_of(area.region.right, sector_of(-X_RB.yaw));
  area.place = orca::seen_from(X_RB, area.place);
  if (area.edge) area.edge->place = orca::seen_from(X_RB, area.edge->place);
  return area;
}

bool is_navigable(std::span<const Vec2> echoes, Vec2 place, double radius) {
  const double way = norm(place);
  if (way <= 0.0) return true;
  const Vec2 along = (1.0 / way) * place;
  std::vector<Vec2> lefts;
  std::vector<Vec2> rights;
  for (const Vec2 echo : echoes) {
    if (norm(echo - place) < radius - kRounding) return false;
    const double ahead = dot(along, echo);
    const double aside = cross(along, echo);
    if (ahead < 0.0 || ahead >= way || std::abs(aside) > 2.0 * radius) continue;
    (aside >= 0.0 ? lefts : rights).push_back(echo);
  }
  const auto is_closed = [&](Vec2 left) {
    return std::ranges::any_of(rights, [&](Vec2 right) { return norm(left - right) < 2.0 * radius; });
  };
  return std::ranges::none_of(lefts, is_closed);
}

std::optional<FreeWalkingArea> free_walking_area(std::span<const Vec2> echoes, const Goal& goal,
                                                 double radius) {
  const Depths seen = depths(echoes, radius);
  const std::vector<Region> all = regions(seen, 2.0 * radius);
  const std::size_t sector = sector_of(goal.direction);
  const Vec2 place = goal.distance * direction(goal.direction);
  if (seen[sector] >= goal.distance && is_navigable(echoes, place, radius))
    return FreeWalkingArea{region_of(sector, all), place, std::nullopt};
  for (const Entrance& way : entrances(all, goal)) {
    const FreeWalkingArea area = area_at(way, echoes, seen, radius);
    if (is_navigable(echoes, area.place, radius)) return area;
  }
  return std::nullopt;
}

}  // namespace orca::nd
