// SPDX-License-Identifier: GPL-3.0-or-later
// The first three stages of VFH+, equations 1 to 11 of the paper (see histogram.hpp).
#include "vfh_plus/histogram.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/angle.hpp"

using namespace orca::vfh;
using std::numbers::pi;

namespace {

constexpr Surroundings kAround{.radius = 0.4, .window = 1.2, .near_weight = 5.0};
constexpr Thresholds kThresholds{.low = 1.5, .high = 2.5};
constexpr double kDegree = pi / 180;

Cell cell_at(double degrees, double distance, double certainty = 1.0) {
  return {distance * orca::direction(degrees * kDegree), certainty};
}

Densities of(const std::vector<Cell>& cells) { return primary_histogram(cells, kAround); }

Densities everywhere(double density) {
  Densities densities;
  densities.fill(density);
  return densities;
}

// Returns the sector in whose middle a direction lies.
std::size_t looking_to(double degrees) {
  return static_cast<std::size_t>(std::lround((degrees < 0.0 ? degrees + 360.0 : degrees) / 5.0)) % kSectors;
}

std::vector<Cell> random_cells(orca::RandomStream& random) {
  std::vector<Cell> cells(random() % 17);
  for (Cell& cell : cells)
    cell = {random.uniform(0.05, 1.5) * orca::direction(random.uniform(-pi, pi)), random.uniform(0.0, 1.0)};
  return cells;
}

Motion ahead(double radius) { return {.heading = 0.0, .radius = radius}; }

}  // namespace

TEST_CASE("the magnitude of a cell falls with the square of its distance, to 1 at the rim of the window",
          "[vfh]") {
  CHECK(magnitude(cell_at(20, 0.0), kAround) == 5.0);
  CHECK(magnitude(cell_at(20, 0.6), kAround) == Approx(5.0 - 4.0 / 4));
  CHECK(magnitude(cell_at(20, 1.2 - 1e-9), kAround) == Approx(1.0));
  CHECK(magnitude(cell_at(20, 1.2 + 1e-9), kAround) == 0.0);
}

TEST_CASE("the magnitude of a cell grows with the square of its certainty", "[vfh]") {
  CHECK(magnitude(cell_at(0, 0.6, 0.5), kAround) == Approx(0.25 * magnitude(cell_at(0, 0.6), kAround)));
  CHECK(magnitude(cell_at(0, 0.6, 0.0), kAround) == 0.0);
}

TEST_CASE("a cell is enlarged by the angle in which the robot and its safety distance would touch it",
          "[vfh]") {
  CHECK(enlargement(0.8, 0.4) == Approx(30 * kDegree));
  CHECK(enlargement(0.8, 0.5) == Approx(std::asin(0.5 / 0.8)));
  CHECK(enlargement(8.0, 0.4) < enlargement(0.8, 0.4));
}

TEST_CASE("a cell nearer than the robot's radius and safety distance blocks all directions towards it",
          "[vfh]") {
  CHECK(enlargement(0.4, 0.4) == Approx(pi / 2));
  CHECK(enlargement(0.1, 0.4) == Approx(pi / 2));
  CHECK(enlargement(0.0, 0.4) == Approx(pi / 2));
}

TEST_CASE("one obstacle counts in the sectors that its enlarged angle covers, and in no other", "[vfh]") {
  const Densities densities = of({cell_at(32, 0.8)});  // 30 degrees to either side
  for (std::size_t k = 0; k < kSectors; ++k) {
    CAPTURE(k);
    const double off = std::abs(orca::wrapped(static_cast<double>(k) * kSector - 32 * kDegree));
    CHECK(densities[k] == (off <= 30 * kDegree ? magnitude(cell_at(32, 0.8), kAround) : 0.0));
  }
}

TEST_CASE("an obstacle behind or ahead of the robot counts on both sides of the seam", "[vfh]") {
  const Densities behind = of({cell_at(179, 0.8)});
  CHECK(behind[looking_to(155)] > 0.0);
  CHECK(behind[looking_to(-155)] > 0.0);
  CHECK(behind[looking_to(-145)] == 0.0);
  const Densities in_front = of({cell_at(-1, 0.8)});
  CHECK(in_front[looking_to(25)] > 0.0);
  CHECK(in_front[looking_to(-25)] > 0.0);
}

TEST_CASE("the magnitudes of obstacles in one direction add up", "[vfh]") {
  const Cell near = cell_at(0, 0.6);
  const Cell far = cell_at(0, 0.9);
  CHECK(of({near, far})[0] == Approx(magnitude(near, kAround) + magnitude(far, kAround)));
}

TEST_CASE("another obstacle never makes a direction freer", "[vfh]") {
  orca::RandomStream random(1, "test", "density");
  for (int i = 0; i < 300; ++i) {
    std::vector<Cell> cells = random_cells(random);
    const Densities before = of(cells);
    cells.push_back(
        cell_at(random.uniform(-180.0, 180.0), random.uniform(0.0, 1.5), random.uniform(0.0, 1.0)));
    const Densities after = of(cells);
    for (std::size_t k = 0; k < kSectors; ++k) CHECK(after[k] >= before[k]);
  }
}

TEST_CASE("a sector is blocked above the upper threshold and free below the lower one", "[vfh]") {
  CHECK(binary_histogram(everywhere(2.6), {}, kThresholds).all());
  CHECK(binary_histogram(everywhere(1.4), Blocked{}.set(), kThresholds).none());
}

TEST_CASE("between the thresholds a sector stays as it was: blocked or free", "[vfh]") {
  Blocked before;
  before.set(3).set(40);
  CHECK(binary_histogram(everywhere(2.0), before, kThresholds) == before);
  CHECK(binary_histogram(everywhere(1.5), before, kThresholds) == before);
  CHECK(binary_histogram(everywhere(2.5), before, kThresholds) == before);
}

TEST_CASE("a robot that turns on the spot has no arcs that anything could block", "[vfh]") {
  orca::RandomStream random(2, "test", "spot");
  for (int i = 0; i < 100; ++i) {
    const std::vector<Cell> cells = random_cells(random);
    const Blocked binary = binary_histogram(of(cells), {}, kThresholds);
    CHECK(masked_histogram(binary, cells, kAround, ahead(0.0)) == binary);
  }
}

TEST_CASE("what is in the way of the arc to the left blocks what lies beyond it on the left, and only there",
          "[vfh]") {  // Straight behind is reached by the arc to the right.
  const std::vector<Cell> cells{cell_at(55, 0.61)};
  const Blocked masked = masked_histogram({}, cells, kAround, ahead(0.5));
  for (std::size_t k = 0; k < kSectors; ++k) {
    CAPTURE(k);
    const double aside = orca::wrapped(static_cast<double>(k) * kSector);
    CHECK(masked[k] == (aside > 55 * kDegree && aside < pi));
  }
}

TEST_CASE("what is straight ahead is in the way of both arcs", "[vfh]") {
  const Blocked masked = masked_histogram({}, std::vector<Cell>{{{0.5, 0.0}, 1.0}}, kAround, ahead(0.5));
  CHECK(masked.count() == kSectors - 1);
  CHECK_FALSE(masked[0]);
}

TEST_CASE("the tighter a robot can turn, the less is masked", "[vfh]") {
  const std::vector<Cell> cells{cell_at(55, 0.61)};
  CHECK(masked_histogram({}, cells, kAround, ahead(0.1)).none());
  CHECK(masked_histogram({}, cells, kAround, ahead(0.5)).any());
}

TEST_CASE("of several obstacles on a side the one nearest to the heading masks", "[vfh]") {
  const std::vector<Cell> cells{cell_at(-80, 0.5), cell_at(-40, 0.5), cell_at(-120, 0.5)};
  const Blocked masked = masked_histogram({}, cells, kAround, ahead(0.5));
  CHECK_FALSE(masked[looking_to(-35)]);
  CHECK(masked[looking_to(-45)]);
  CHECK_FALSE(masked[looking_to(90)]);
}

TEST_CASE("what lies beyond the window or beside both arcs masks nothing", "[vfh]") {
  CHECK(masked_histogram({}, std::vector<Cell>{cell_at(55, 1.3)}, kAround, ahead(5.0)).none());
  CHECK(masked_histogram({}, std::vector<Cell>{cell_at(5, 1.1)}, kAround, ahead(0.5)).none());
}

TEST_CASE("masking only blocks more, and turns with the robot", "[vfh]") {
  orca::RandomStream random(3, "test", "mask");
  for (int i = 0; i < 200; ++i) {
    std::vector<Cell> cells = random_cells(random);
    const double radius = random.uniform(0.01, 2.0);
    const Blocked binary = binary_histogram(of(cells), {}, kThresholds);
    const Blocked masked = masked_histogram(binary, cells, kAround, ahead(radius));
    CHECK((binary & ~masked).none());
    for (Cell& cell : cells) cell.place = rotated(cell.place, pi / 2);
    const Blocked turned =
        masked_histogram(binary_histogram(of(cells), {}, kThresholds), cells, kAround, {pi / 2, radius});
    const std::size_t quarter = kSectors / 4;
    CHECK(turned == (masked << quarter | masked >> (kSectors - quarter)));
  }
}
