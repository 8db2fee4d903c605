// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "orca/navigation/path_planner.hpp"

namespace orca::nav {
namespace {

constexpr int kSettle = 3;          // times that the middle is looked for again
constexpr double kOpposite = -0.5;  // cosine of the angle between both sides, at most
constexpr double kEvery = 0.1;      // [m] at which a path is searched for gaps
constexpr double kOffMiddle = 0.2;  // [m] from the path to the middle of a gap that belongs to it
constexpr double kSpare = 0.05;     // [m] beside a robot that turns round
constexpr double kJoin =
    0.3;  // [m] at least between two bends where a piece through a gap joins what is beside it
constexpr std::array kRuns{
    0.4, 0.25, 0.1};  // [m] of straight path before the nose and behind the tail, the longest that fits

struct Pair {
  Vec2 one;
  Vec2 other;
};

std::optional<Pair> sides_of(const OccupancyMap& map, Vec2 place, double reach) {
  std::optional<Vec2> one;
  std::optional<Vec2> other;
  map.for_points_near(place, reach, [&](Vec2 point) {
    if (!one || norm(point - place) < norm(*one - place)) one = point;
  });
  if (!one) return std::nullopt;
  map.for_points_near(place, reach, [&](Vec2 point) {
    const double cosine =
        dot(point - place, *one - place) / std::max(1e-9, norm(point - place) * norm(*one - place));
    if (cosine < kOpposite && (!other || norm(point - place) < norm(*other - place))) other = point;
  });
  if (!other || norm(*other - place) > reach) return std::nullopt;
  return Pair{*one, *other};
}

// Returns the straight piece through a gap, as long as the outline finds room.
std::optional<Pair> piece_through(const OccupancyMap& map, const Footprint& footprint, const Gap& gap) {
  for (const double run : kRuns) {
    const Vec2 half = (footprint.half_length + run) * gap.axis;
    const std::array ends{gap.middle - half, gap.middle + half};
    const Path piece(ends);
    if (touches_along(map, footprint, piece, 0.0, piece.length()) < 0.0) return Pair{ends[0], ends[1]};
  }
  return std::nullopt;
}

// Returns the narrowest gap of the part of a path that begins at `along` and ends where no gap is; `along` becomes that end.
std::optional<Gap> narrowest(const OccupancyMap& map, const Footprint& footprint, const Path& path,
                             double& along) {
  std::optional<Gap> best;
  const double most = 2.0 * (footprint.outer_radius() + kSpare);
  for (; along < path.length(); along += kEvery) {
    const Vec2 place = path.at(along);
    const auto gap = gap_around(map, place, direction(path.heading(along)), 0.5 * most + kOffMiddle);
    const bool counts = gap && gap->width < most && norm(gap->middle - place) < kOffMiddle;
    if (!counts && best) return best;
    if (counts && (!best || gap->width < best->width)) best = gap;
  }
  return best;
}

}  // namespace

std::optional<Gap> gap_around(const OccupancyMap& map, Vec2 place, Vec2 heading, double reach) {
  Gap gap{place, {}, 0.0};
  for (int i = 0; i < kSettle; ++i) {
    const auto sides = sides_of(map, gap.middle, reach);
    if (!sides) return std::nullopt;
    const Vec2 across = sides->other - sides->one;
    gap.width = norm(across);
    gap.middle = 0.5 * (sides->one + sides->other);
    gap.axis = (1.0 / std::max(1e-9, gap.width)) * Vec2{-across.y, across.x};
    if (dot(gap.axis, heading) < 0.0) gap.axis = -1.0 * gap.axis;
  }
  return gap;
}

Path lined_up(const OccupancyMap& map, const Footprint& footprint, const Path& path) {
  if (footprint.is_circle() || path.length() < kEvery) return path;
  std::vector<Vec2> points{path.at(0.0)};
  double done = 0.0;  // [m] of the path that `points` already covers
  const auto copy_to = [&](double end) {
    for (; done + kEvery < end; done += kEvery) points.push_back(path.at(done + kEvery));
  };
  // A step aside between two near points would turn the robot across the gap.
  const auto make_room_for = [&](Vec2 next) {
    while (points.size() > 1 && norm(next - points.back()) < kJoin) points.pop_back();
  };
  for (double along = 0.0; along < path.length();) {
    const auto gap = narrowest(map, footprint, path, along);
    const auto piece = gap ? piece_through(map, footprint, *gap) : std::nullopt;
    if (!piece) continue;
    const double begin = path.nearest(piece->one, done, path.length());
    const double end = path.nearest(piece->other, begin, path.length());
    copy_to(begin);
    if (begin > done) {
      make_room_for(piece->one);
      points.push_back(piece->one);
    }
    done = std::max(done, begin);
    along = std::max(along, end);
    if (end >= path.length()) continue;  // It leads into the gap, not through it.
    make_room_for(gap->middle);
    points.push_back(gap->middle);
    points.push_back(piece->other);
    done = std::max(done, end + kJoin - kEvery);
  }
  copy_to(path.length());
  points.push_back(path.at(path.length()));
  return Path(points);
}

}  // namespace orca::nav
