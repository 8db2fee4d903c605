// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/tracking/free_floor.hpp"

#include <algorithm>

#include "orca/navigation/lattice.hpp"

namespace orca::tracking {
namespace {

constexpr double kSurface = 1.2;  // [m] between echoes that may be of one wall

constexpr std::ptrdiff_t kSurfaceEchoes = 4;
constexpr double kGrazing = 0.7;  // cosine of the angle between a beam and a wall that may fade out
constexpr std::size_t kOpen = 2;  // beams to each side

// Odometry is wrong by some degrees in the time for which the floor is remembered, and moves walls by that share of their distance.
constexpr double kError = 0.1;       // [m] around an echo
constexpr double kTurnError = 0.03;  // [rad]

double room_around(const nav::Beam& beam) { return kError + kTurnError * norm(beam.to - beam.from); }

constexpr nav::Lattice kLattice{{0.0, 0.0}, FreeFloor::kSide, 0, 0};

std::size_t place_of(int column, int row) {
  constexpr auto kMask = static_cast<unsigned>(FreeFloor::kCells - 1);
  return (static_cast<unsigned>(row) & kMask) * static_cast<std::size_t>(FreeFloor::kCells) +
         (static_cast<unsigned>(column) & kMask);
}

}  // namespace

FreeFloor::Cell& FreeFloor::at(int column, int row) {
  Cell& cell = cells_[place_of(column, row)];
  if (cell.column == column && cell.row == row) return cell;
  cell = {};
  cell.column = column;
  cell.row = row;
  return cell;
}

const FreeFloor::Cell* FreeFloor::find(Vec2 place) const {
  const nav::Cell where = kLattice.cell_at(place);
  const Cell& cell = cells_[place_of(where.column, where.row)];
  return cell.column == where.column && cell.row == where.row ? &cell : nullptr;
}

void FreeFloor::see(std::span<const nav::Beam> scan, double time) {
  ++scan_;
  const nav::Beam* last = nullptr;
  for (const nav::Beam& beam : scan) {
    if (!beam.echo) continue;
    block(beam.to, room_around(beam));
    if (last != nullptr && norm(beam.to - last->to) < kSurface) block_surface(*last, beam);
    last = &beam;
  }
  block_faded(scan);
  for (const nav::Beam& beam : scan)
    if (beam.echo) look_through(beam, time);
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (!scan[i].echo && is_open(scan, i)) look_through(scan[i], time);
}

// A wall along which the beams graze gives no echo from some distance on, though it goes on.
void FreeFloor::block_faded(std::span<const nav::Beam> scan) {
  const auto count = static_cast<std::ptrdiff_t>(scan.size());
  for (std::ptrdiff_t i = 0; i < count; ++i)
    for (const std::ptrdiff_t step : {-1, 1}) {
      const std::ptrdiff_t before = i - step * kSurfaceEchoes;
      if (i + step < 0 || i + step >= count || before < 0 || before >= count) continue;
      if (!scan[i].echo || scan[i + step].echo || !scan[before].echo) continue;
      const Vec2 along = scan[i].to - scan[before].to;
      const Vec2 beam = scan[i].to - scan[i].from;
      if (dot(along, beam) < kGrazing * norm(along) * norm(beam)) continue;
      const double reach = norm(scan[i + step].to - scan[i + step].from);
      for (double way = kSide; way < reach; way += kSide)
        block(scan[i].to + (way / norm(along)) * along, room_around(scan[i]));
    }
}

// A single beam without echo may have met something that reflects it elsewhere.
bool FreeFloor::is_open(std::span<const nav::Beam> scan, std::size_t i) {
  const std::size_t last = std::min(i + kOpen, scan.size() - 1);
  for (std::size_t k = i - std::min<std::size_t>(i, kOpen); k <= last; ++k)
    if (scan[k].echo) return false;
  return true;
}

void FreeFloor::block(Vec2 place, double room) {
  const nav::Cell low = kLattice.cell_at(place - Vec2{room, room});
  const nav::Cell high = kLattice.cell_at(place + Vec2{room, room});
  for (int row = low.row; row <= high.row; ++row)
    for (int column = low.column; column <= high.column; ++column) {
      Cell& cell = at(column, row);
      cell.echoed = scan_;
      cell.in_a_row = 0;
    }
}

// Between echoes along a wall that is seen at a grazing angle, beams pass through cells in which the wall stands.
void FreeFloor::block_surface(const nav::Beam& from, const nav::Beam& to) {
  const Vec2 way = to.to - from.to;
  const int steps = static_cast<int>(norm(way) / kSide);
  for (int i = 1; i < steps; ++i) block(from.to + (1.0 * i / steps) * way, room_around(to));
}

void FreeFloor::look_through(const nav::Beam& beam, double time) {
  const Vec2 way = beam.to - beam.from;
  const double length = norm(way);
  const double seen = length - (beam.echo ? room_around(beam) : 0.0);
  if (seen <= 0.0) return;
  nav::walk_line(kLattice, beam.from, beam.from + (seen / length) * way, [&](nav::Cell where) {
    Cell& cell = at(where.column, where.row);
    if (cell.echoed == scan_ || cell.looked_through == scan_) return true;
    cell.looked_through = scan_;
    if (++cell.in_a_row >= kSure) (beam.echo ? cell.free_at : cell.open_at) = time;
    return true;
  });
}

bool FreeFloor::was_free(Vec2 place, double time) const {
  const Cell* cell = find(place);
  return cell != nullptr && time - cell->free_at <= kLately;
}

bool FreeFloor::was_open(Vec2 place, double time) const {
  const Cell* cell = find(place);
  return cell != nullptr && time - cell->open_at <= kLately;
}

bool FreeFloor::is_seen_free(Vec2 place) const {
  const Cell* cell = find(place);
  return cell != nullptr && cell->looked_through == scan_;
}

}  // namespace orca::tracking
