// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/known_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "orca/base/portable_math.hpp"
#include "orca/navigation/distance_transform.hpp"

namespace orca::nav {
namespace {

constexpr double kCentimetre = 0.01;

// Returns how far each cell is from the next one that is chosen [cm].
template <typename Chosen>
std::vector<std::uint8_t> distances_of(const FloorGrid& grid, Chosen chosen) {
  std::vector<std::uint8_t> marks(grid.lattice.size());
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = chosen(grid.lattice.cell_of(i)) ? 1 : 0;
  const int reach = static_cast<int>(std::ceil(KnownMap::kReach / grid.lattice.side));
  DistanceTransform transform;
  const auto squared = transform(marks, grid.lattice.columns, grid.lattice.rows, reach);
  std::vector<std::uint8_t> distances(squared.size());
  for (std::size_t i = 0; i < distances.size(); ++i)
    distances[i] = static_cast<std::uint8_t>(
        std::min(KnownMap::kReach / kCentimetre,
                 std::sqrt(static_cast<double>(squared[i])) * grid.lattice.side / kCentimetre));
  return distances;
}

SurfaceMap surface_map_of(const FloorGrid& grid) {
  SurfaceMap map;
  map.add(surface_of(grid), {});
  map.prepare();
  return map;
}

// Returns the corners of all blocks of the search's top level in which the map is free somewhere, row by row.
std::vector<Cell> free_blocks_of(const FloorGrid& grid, const ScanSearch& search) {
  constexpr int kTop = ScanSearch::kLevels - 1;
  std::set<std::pair<int, int>> blocks;
  std::pair<int, int> last{};
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const Cell cell = grid.lattice.cell_of(i);
    if (!grid.free(cell)) continue;
    const Cell at = search.lattice().cell_at(grid.lattice.middle_of(cell));
    const std::pair<int, int> block{at.row >> kTop, at.column >> kTop};
    if (block != last || blocks.empty()) blocks.insert(block);
    last = block;
  }
  std::vector<Cell> corners;
  corners.reserve(blocks.size());
  for (const auto& [row, column] : blocks) corners.push_back({column * (1 << kTop), row * (1 << kTop)});
  return corners;
}

}  // namespace

KnownMap::KnownMap(FloorGrid grid)
    : grid_(std::move(grid)),
      distance_(distances_of(grid_, [this](Cell cell) { return grid_.occupied(cell); })),
      clear_(distances_of(grid_, [this](Cell cell) { return !grid_.free(cell); })),
      surface_(surface_map_of(grid_)),
      search_(surface_.points()),
      free_blocks_(surface_.points().empty() ? std::vector<Cell>{} : free_blocks_of(grid_, search_)) {}

double KnownMap::distance(Vec2 place) const {
  const Cell cell = grid_.lattice.cell_at(place);
  return grid_.lattice.holds(cell) ? kCentimetre * distance_[grid_.lattice.index(cell)] : kReach;
}

// Strides as far as nothing can be in the way.
Sight KnownMap::look(Vec2 from, Vec2 ahead, double most) const {
  const double side = grid_.lattice.side;
  for (double range = 0.0; range < most;) {
    const Cell cell = grid_.lattice.cell_at(from + range * ahead);
    if (grid_.occupied(cell)) return {range, Sight::End::wall};
    if (!grid_.free(cell)) return {range, Sight::End::unknown};
    range += std::max(0.5 * side, kCentimetre * clear_[grid_.lattice.index(cell)] - 1.5 * side);
  }
  return {most, Sight::End::nothing};
}

Explanation KnownMap::explain(std::span<const SurfacePoint> scan, Vec2 sensor, const Pose2& X_MR) const {
  Explanation result;
  const Vec2 from = X_MR * sensor;
  const Vec2 turned = direction(X_MR.yaw);
  double all = 0.0;
  double all_of_room = 0.0;
  for (const SurfacePoint& point : scan) {
    const Vec2 to = X_MR.position() + rotated(point.at, turned);
    const double off = distance_to_surface(to);
    const double range = norm(to - from);
    const double closeness = 1.0 / (1.0 + off * off / (kSoft * kSoft));
    all += 1.0;
    all_of_room += 1.0;
    result.fit += closeness;
    result.fit_of_room += closeness;
    if (off <= kOff) {
      result.hits += 1.0;
      continue;
    }
    const Sight sight = look(from, 1.0 / std::max(range, 1e-9) * (to - from), range);
    if (sight.end == Sight::End::nothing) {
      result.shorts += 1.0;
      // Echoes in front count half, those where the map knows nothing in full: a wrong place would gain by these.
      all -= 0.5;
      const double left_out = 1.0 - 0.5 * std::min(1.0, range / kNear);
      all_of_room -= left_out;
      result.fit_of_room -= left_out * closeness;
    }
    if (sight.end == Sight::End::wall) result.longs += 1.0;
  }
  if (all > 0.0) result.fit /= all;
  // Where nearly all is hidden the rest says nothing.
  const bool sees_room = all_of_room > 0.0 && all_of_room >= kRest * static_cast<double>(scan.size());
  result.fit_of_room = sees_room ? result.fit_of_room / all_of_room : result.fit;
  return result;
}

double KnownMap::distance_to_surface(Vec2 place) const {
  const SurfacePoint* const surface = surface_.nearest(place, kBeside);
  if (surface == nullptr) return kReach;
  const Vec2 off = place - surface->at;
  return surface->normal == Vec2{} ? norm(off) : std::fabs(dot(off, surface->normal));
}

double likelihood(std::span<const SurfacePoint> scan, const KnownMap& map, const Pose2& X_MR) {
  constexpr double kSoft = 0.15;  // [m]
  constexpr double kElse = 0.1;   // by chance
  constexpr double kShare = 0.3;  // of the evidence of a beam, as neighbours show the same
  const Vec2 turned = direction(X_MR.yaw);
  double sum = 0.0;
  for (const SurfacePoint& point : scan) {
    const double off = map.distance(X_MR.position() + rotated(point.at, turned)) / kSoft;
    sum += portable::log(portable::exp(-0.5 * off * off) + kElse);
  }
  return std::max(1e-100, portable::exp(kShare * sum));
}

namespace {

// Returns by how much better a scan must fit at a pose than where the robot should be.
double margin_to(const Pose2& pose, const PoseSpread& prior, const FitMargin& margin) {
  constexpr double kMost = 0.15;  // [1] A slip of the wheels shows by it.
  return std::clamp(0.5 * squared_distance(prior, pose) / margin.evidence, margin.apart, kMost);
}

// Lays a scan where it fits best about where the robot should be. The prior decides what is looked at, but counts only once.
std::optional<ScanMatch> lay_there(std::span<const SurfacePoint> scan, const KnownMap& map,
                                   const PoseSpread& prior, MatchOptions options, const FitMargin& margin) {
  constexpr double kUsual = 9.0;  // squared distance
  constexpr double kOwn = 0.03;   // [m], [rad] by which a scan alone is off
  const std::optional<ScanMatch> held =
      refine(scan, map.surface(), prior.mean, options, information_of(prior));
  if (!held) return std::nullopt;
  options.reach = options.inlier;
  const std::optional<ScanMatch> pulled = refine(scan, map.surface(), held->X_MR, options);
  if (!pulled) return std::nullopt;
  PoseSpread expected = prior;
  for (const std::size_t i : {0U, 4U, 8U}) expected.covariance[i] += kOwn * kOwn;
  const bool is_usual = squared_distance(expected, pulled->X_MR) <= kUsual;
  return is_usual || pulled->fit >= held->fit + margin_to(pulled->X_MR, expected, margin) ? pulled : held;
}

}  // namespace

PoseSpread spread_of(const ScanMatch& laid) {
  PoseInformation known = laid.information;
  known.xx += 100.0;
  known.yy += 100.0;
  known.tt += 200.0;
  return {laid.X_MR, covariance_of(known, laid.X_MR.yaw)};
}

std::optional<ScanMatch> lay_near(std::span<const SurfacePoint> scan, const KnownMap& map,
                                  const PoseSpread& prior, const MatchOptions& options,
                                  const FitMargin& margin) {
  constexpr double kSurely = 0.8;  // [1] share of a scan on the map for which no better place is looked for
  const double deviation = deviation_of(prior);
  MatchOptions close = options;
  close.reach = std::min(close.reach, kCloseReach + 3.0 * deviation);
  const std::optional<ScanMatch> here = lay_there(scan, map, prior, close, margin);
  if (here && here->share >= kSurely) return here;
  const double way = std::clamp(3.0 * deviation, 0.3, 1.0);
  const double turn = std::clamp(3.0 * std::sqrt(prior.covariance[8]), 0.2, 0.5);
  const auto found = map.search().best(thinned(scan, 0.1, 90), {prior.mean, way, turn}, 0.0);
  if (!found) return here;
  close.reach = kCloseReach;
  const std::optional<ScanMatch> other = refine(scan, map.surface(), found->X_MR, close);
  if (!other || !here) return other ? other : here;
  return other->fit > here->fit + margin_to(other->X_MR, prior, margin) ? other : here;
}

}  // namespace orca::nav
