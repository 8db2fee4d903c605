// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <numbers>

#include "plan.hpp"

namespace orca::sim::detail {
namespace {

constexpr int kSide = 30;
constexpr double kCell = 0.15;  // [m]
constexpr double kLeft = -4.5;  // [m] Left end of the field and of its first row.
constexpr double kFront = 5.1;

class Cells {
 public:
  [[nodiscard]] bool filled(int column, int row) const {
    return column >= 0 && row >= 0 && column < kSide && row < kSide && cells_[index(column, row)];
  }
  void set(int column, int row, bool value) { cells_[index(column, row)] = value; }
  [[nodiscard]] int neighbours(int column, int row) const {
    int count = 0;
    for (int r = row - 1; r <= row + 1; ++r)
      for (int c = column - 1; c <= column + 1; ++c) count += (c != column || r != row) && filled(c, r);
    return count;
  }

 private:
  static std::size_t index(int column, int row) { return static_cast<std::size_t>(row * kSide + column); }
  std::array<bool, kSide * kSide> cells_{};
};

template <class Visit>
void for_each_cell(const Visit& visit) {
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) visit(column, row);
}

// Gathers scattered cells by one round of a cellular automaton. Cells outside the field count as free.
Cells smoothed(const Cells& before) {
  Cells after = before;
  for_each_cell([&](int column, int row) {
    const int around = before.neighbours(column, row);
    if (around >= 5) after.set(column, row, true);
    if (around <= 1) after.set(column, row, false);
  });
  return after;
}

Vec2 middle(int column, double first_row, int row) {
  return {kLeft + kCell * (column + 0.5), first_row + kCell * (row + 0.5)};
}

void add_cylinder(WorldModel& world, Vec2 center) {
  world.obstacles.push_back({"cylinder", Circle{center, 0.5 * kCell}, kTall});
}

// Adds rows of cylinders on all four sides, in the outermost cells.
void add_rim(WorldModel& world) {
  const int rows = 100;  // From y = 0 to the end of the strip behind the field, at 15 m.
  for (int row = 0; row < rows; ++row)
    for (const int column : {0, kSide - 1}) add_cylinder(world, middle(column, 0.0, row));
  for (int column = 1; column < kSide - 1; ++column)
    for (const int row : {0, rows - 1}) add_cylinder(world, middle(column, 0.0, row));
}

}  // namespace

WorldModel draw(const BarnField& family, RandomStream& random) {
  const double fill = 0.15 + 0.05 * static_cast<double>(pick(random, 0, 3));
  const std::size_t rounds = pick(random, 2, 4);
  Cells cells;
  for_each_cell(
      [&](int column, int row) { cells.set(column, row, random.chance(family.fill.value_or(fill))); });
  for (std::size_t round = 0; round < family.rounds.value_or(rounds); ++round) cells = smoothed(cells);
  WorldModel world;
  add_rim(world);
  for_each_cell([&](int column, int row) {
    const bool in_rim = column == 0 || column == kSide - 1;
    if (cells.filled(column, row) && !in_rim) add_cylinder(world, middle(column, kFront, row));
  });
  const double ahead = 0.5 * std::numbers::pi;
  world.places = {{"start", {-2.25, 3.0, ahead}}, {"goal", {-2.25, 13.0, ahead}}};
  return world;
}

std::string fault_of(const BarnField& family, double radius) {
  if (family.fill && !(*family.fill >= 0.0 && *family.fill <= 0.5)) return "fill must be between 0 and 0.5";
  if (family.rounds && *family.rounds > 20) return "rounds must be at most 20";
  return too_narrow("the field", kSide * kCell, radius);
}

}  // namespace orca::sim::detail
