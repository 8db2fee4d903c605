// SPDX-License-Identifier: GPL-3.0-or-later
// The nearness diagram of ND+ with its gaps and regions (see diagram.hpp).
#include "nd_plus/diagram.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "orca/base/random.hpp"

using namespace orca::nd;
using orca::Vec2;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kJoined = 0.3;    // [m]
constexpr double kDiameter = 0.6;  // [m]

// A wall across the way, `distance` [m] ahead, from y = right to y = left.
void add_wall(std::vector<Vec2>& echoes, double distance, double right, double left) {
  for (double y = right; y <= left + 1e-9; y += 0.1) echoes.push_back({distance, y});
}

std::vector<Vec2> ring(double distance) {
  std::vector<Vec2> echoes;
  for (int i = 0; i < 72; ++i) echoes.push_back(distance * orca::direction(i * kPi / 36));
  return echoes;
}

std::vector<Region> regions_of(const std::vector<Vec2>& echoes) {
  return regions(depths(echoes, kJoined), kDiameter);
}

}  // namespace

TEST_CASE("sector 0 looks ahead, and sectors are counted to the left", "[nd]") {
  CHECK(direction_of(0) == 0.0);
  CHECK(direction_of(36) == Approx(kPi / 2));
  CHECK(direction_of(108) == Approx(-kPi / 2));
  for (std::size_t k = 0; k < kSectors; ++k) CHECK(sector_of(direction_of(k)) == k);
  for (std::size_t k = 1; k < kSectors / 2; ++k) CHECK(direction_of(k) == -direction_of(kSectors - k));
}

TEST_CASE("the depth of a sector is the distance to the nearest echo in it", "[nd]") {
  const Depths seen = depths(std::vector<Vec2>{{0.0, 2.0}, {0.0, 1.0}}, kJoined);
  CHECK(seen[36] == 1.0);
  CHECK(std::isinf(seen[35]));
  CHECK(std::isinf(seen[37]));
}

TEST_CASE("echoes near to each other are one surface, others leave the sectors between them open", "[nd]") {
  const Depths closed = depths(std::vector<Vec2>{{1.0, -0.14}, {1.0, 0.14}}, kJoined);
  CHECK(closed[0] == Approx(1.0));
  CHECK(closed[2] == Approx(1.0 / std::cos(2 * kSector)));
  CHECK(std::isinf(closed[5]));
  const Depths open = depths(std::vector<Vec2>{{1.0, -0.16}, {1.0, 0.16}}, kJoined);
  CHECK(std::isinf(open[0]));
}

TEST_CASE("a doorway in a wall is a region with a rising gap at each side", "[nd]") {
  std::vector<Vec2> echoes;
  add_wall(echoes, 1.0, -1.5, -0.4);
  add_wall(echoes, 1.0, 0.4, 1.5);
  const std::vector<Region> found = regions_of(echoes);
  REQUIRE(found.size() == 2);
  const auto door = std::ranges::find_if(found, [](const Region& region) { return region.holds(0); });
  REQUIRE(door != found.end());
  CHECK(door->rises_right);
  CHECK(door->rises_left);
  CHECK(door->middle() == Approx(0.0).margin(1e-9));
  CHECK(static_cast<double>(door->width) * kSector == Approx(2 * std::atan(0.4)).margin(2 * kSector));
  const Region& behind = *std::ranges::find_if(found, [](const Region& region) { return region.holds(72); });
  CHECK(std::abs(behind.middle()) == Approx(kPi));
}

TEST_CASE("what stands before a wall makes two regions beside it, but is none itself", "[nd]") {
  std::vector<Vec2> echoes;
  for (double y = -3.0; y <= 3.0; y += 0.2) echoes.push_back({2.0, y});
  add_wall(echoes, 0.8, -0.2, 0.2);
  for (const Region& region : regions_of(echoes)) CHECK_FALSE(region.holds(0));
  CHECK(regions_of(echoes).size() >= 2);
}

TEST_CASE("if nothing is seen all sectors are one region, and in a closed room there is none", "[nd]") {
  const std::vector<Region> open = regions_of({});
  REQUIRE(open.size() == 1);
  CHECK(open.front().width == kSectors);
  CHECK(regions_of(ring(1.0)).empty());
}

TEST_CASE("a room with one way out has one region", "[nd]") {
  std::vector<Vec2> echoes = ring(1.0);
  std::erase_if(echoes, [](Vec2 echo) { return echo.y > 0.8; });
  const std::vector<Region> found = regions_of(echoes);
  REQUIRE(found.size() == 1);
  CHECK(found.front().rises_right);
  CHECK(found.front().rises_left);
  CHECK(found.front().middle() == Approx(kPi / 2));
}

TEST_CASE("a mirrored scene has the mirrored diagram", "[nd]") {
  orca::RandomStream random(1, "test", "nd");
  for (int i = 0; i < 100; ++i) {
    std::vector<Vec2> echoes;
    std::vector<Vec2> mirrored;
    for (int j = 0; j < 30; ++j) {
      echoes.push_back({random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)});
      mirrored.push_back({echoes.back().x, -echoes.back().y});
    }
    const Depths one = depths(echoes, kJoined);
    const Depths other = depths(mirrored, kJoined);
    CHECK(one[0] == Approx(other[0]));
    for (std::size_t k = 1; k < kSectors; ++k) CHECK(one[k] == Approx(other[kSectors - k]));
  }
}
