// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/occupancy_map.hpp"

#include <cmath>
#include <cstring>

namespace orca::nav {
namespace {

constexpr int kHit = 4;
constexpr int kMiss = 2;
constexpr int kKeep =
    7;  // An echo moves the point of an occupied cell by an eighth of the way: the noise of beams averages out.
constexpr int kMost = 16;
constexpr int kLeast = -8;  // Three echoes make a cell occupied that has long been free.

std::uint8_t share_of_cell(double coordinate, double corner, double side) {
  const double cells = (coordinate - corner) / side;
  return static_cast<std::uint8_t>(std::clamp((cells - std::floor(cells)) * 256.0, 0.0, 255.0));
}

}  // namespace

OccupancyMap::OccupancyMap(double side, double extent) {
  const int cells = std::max(1, static_cast<int>(std::lround(extent / side)));
  lattice_ = {{}, side, cells, cells};
  reset({});
}

OccupancyMap::OccupancyMap(const FloorGrid& grid) : lattice_(grid.lattice), cells_(grid.lattice.size()) {
  constexpr std::uint8_t kMiddle = 128;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell cell = lattice_.cell_of(i);
    if (grid.occupied(cell)) cells_[i] = {kHit, {kMiddle, kMiddle}, 0};
    if (grid.free(cell)) cells_[i].evidence = -kMiss;
  }
}

void OccupancyMap::reset(Vec2 middle) {
  // On whole cells of the frame, so that a map does not depend on where the robot happened to be first.
  const auto snapped = [this](double value) { return std::floor(value / lattice_.side) * lattice_.side; };
  const double half = 0.5 * lattice_.side * lattice_.columns;
  lattice_.corner = {snapped(middle.x - half), snapped(middle.y - half)};
  cells_.assign(lattice_.size(), {});
}

void OccupancyMap::follow(Vec2 place) {
  const Cell here = lattice_.cell_at(place);
  const int half = lattice_.columns / 2;
  const auto off = [half](int index) { return std::abs(index - half) > half / 2 ? index - half : 0; };
  const Cell shift{off(here.column), off(here.row)};
  if (shift == Cell{}) return;
  std::vector<State> moved(cells_.size());
  for (int row = 0; row < lattice_.rows; ++row)
    for (int column = 0; column < lattice_.columns; ++column) {
      const Cell from{column + shift.column, row + shift.row};
      if (lattice_.holds(from)) moved[lattice_.index({column, row})] = cells_[lattice_.index(from)];
    }
  cells_ = std::move(moved);
  lattice_.corner = lattice_.corner + lattice_.side * Vec2{double(shift.column), double(shift.row)};
}

void OccupancyMap::fade() {
  for (State& cell : cells_)
    cell.evidence -= static_cast<std::int8_t>((cell.evidence > 0) - (cell.evidence < 0));
}

std::string OccupancyMap::packed() const {
  std::string text(sizeof lattice_ + sizeof scan_ + cells_.size() * sizeof(State), '\0');
  std::memcpy(text.data(), &lattice_, sizeof lattice_);
  std::memcpy(text.data() + sizeof lattice_, &scan_, sizeof scan_);
  std::memcpy(text.data() + sizeof lattice_ + sizeof scan_, cells_.data(), cells_.size() * sizeof(State));
  return text;
}

bool OccupancyMap::unpack(std::string_view text) {
  Lattice lattice;
  const std::size_t cells = cells_.size() * sizeof(State);
  if (text.size() != sizeof lattice + sizeof scan_ + cells) return false;
  std::memcpy(&lattice, text.data(), sizeof lattice);
  if (lattice.side != lattice_.side || lattice.columns != lattice_.columns || lattice.rows != lattice_.rows)
    return false;
  lattice_ = lattice;
  std::memcpy(&scan_, text.data() + sizeof lattice_, sizeof scan_);
  std::memcpy(cells_.data(), text.data() + sizeof lattice_ + sizeof scan_, cells);
  return true;
}

void OccupancyMap::see(std::span<const Beam> scan) {
  if (++scan_ == 0) {  // 0 marks cells that no scan has counted in
    for (State& cell : cells_) cell.scan = 0;
    scan_ = 1;
  }
  for (const Beam& beam : scan)
    if (beam.echo) hit(beam);
  for (const Beam& beam : scan) look_through(beam);
}

void OccupancyMap::hit(const Beam& beam) {
  const Cell cell = lattice_.cell_at(beam.to);
  if (!lattice_.holds(cell)) return;
  State& state = cells_[lattice_.index(cell)];
  const std::array at{share_of_cell(beam.to.x, lattice_.corner.x, lattice_.side),
                      share_of_cell(beam.to.y, lattice_.corner.y, lattice_.side)};
  for (std::size_t i = 0; i < at.size(); ++i)
    state.at[i] =
        state.evidence > 0 ? static_cast<std::uint8_t>((kKeep * state.at[i] + at[i]) / (kKeep + 1)) : at[i];
  if (state.scan == scan_) return;
  state.scan = scan_;
  state.evidence = static_cast<std::int8_t>(std::min(state.evidence + kHit, kMost));
}

void OccupancyMap::look_through(const Beam& beam) {
  walk_line(lattice_, beam.from, beam.to, [&](Cell cell) {
    if (!lattice_.holds(cell)) return false;
    State& state = cells_[lattice_.index(cell)];
    const bool counts = state.scan != scan_ && (beam.echo || state.evidence <= 0);
    if (!counts) return true;
    state.scan = scan_;
    state.evidence = static_cast<std::int8_t>(std::max(state.evidence - kMiss, kLeast));
    // Evidence that has run out is not the same as never seen.
    if (state.evidence == 0) state.evidence = -kMiss;
    return true;
  });
}

void OccupancyMap::clear_along(std::span<const Beam> scan) {
  for (const Beam& beam : scan)
    walk_line(lattice_, beam.from, beam.to, [&](Cell cell) {
      if (!lattice_.holds(cell)) return false;
      State& state = cells_[lattice_.index(cell)];
      if (state.evidence > 0) state.evidence = -kMiss;
      return true;
    });
  for (const Beam& beam : scan)
    if (const Cell cell = lattice_.cell_at(beam.to); beam.echo && lattice_.holds(cell))
      cells_[lattice_.index(cell)].evidence = kHit;
}

void OccupancyMap::hold(Vec2 place) {
  const Cell cell = lattice_.cell_at(place);
  if (!lattice_.holds(cell)) return;
  State& state = cells_[lattice_.index(cell)];
  if (state.evidence <= 0)
    state.at = {share_of_cell(place.x, lattice_.corner.x, lattice_.side),
                share_of_cell(place.y, lattice_.corner.y, lattice_.side)};
  state.evidence = kMost;
}

void OccupancyMap::forget_beyond(Vec2 place, double distance) {
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (norm(lattice_.middle_of(lattice_.cell_of(i)) - place) > distance) cells_[i] = {};
}

Vec2 OccupancyMap::point(Cell cell) const {
  const State& state = cells_[lattice_.index(cell)];
  const auto along = [this](int number, std::uint8_t share) {
    return (number + (share + 0.5) / 256.0) * lattice_.side;
  };
  return lattice_.corner + Vec2{along(cell.column, state.at[0]), along(cell.row, state.at[1])};
}

}  // namespace orca::nav
