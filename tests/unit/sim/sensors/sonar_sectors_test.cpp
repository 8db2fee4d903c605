// SPDX-License-Identifier: GPL-3.0-or-later
// The coarse search for the sonars that face a listener, against the exact one.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "sensors/sonar_sectors.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::sim;
using detail::Sector;
using detail::Sectors;
using orca::sim::test::kPi;

namespace {

Sector sector_at(const Pose2& sensor, double half_angle, double sent, double silent) {
  return {detail::Beam(sensor, detail::Lobe(half_angle), 0.0, 1.0, 0.0, 0), sent, silent};
}

Sector random_sector(RandomStream& random, Vec2 middle, double base, double widest) {
  const Vec2 tip = middle + Vec2{random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0)};
  const double sent = base + random.uniform(-0.04, 0.01);
  // A quarter look along an axis, where the bins end.
  const double yaw =
      random.chance(0.25) ? 0.5 * kPi * std::floor(random.uniform(-1.0, 3.0)) : random.uniform(-kPi, kPi);
  const double half_angle = random.uniform(0.05, widest);
  return sector_at({tip.x, tip.y, yaw}, half_angle, sent, sent + random.uniform(0.001, 0.04));
}

bool holds(const Sector& one, Vec2 point) {
  const Vec2 to = point - one.tip;
  return std::fabs(wrapped(std::atan2(to.y, to.x) - one.yaw)) <= one.half_angle;
}

bool faces(const Sector& one, const Sector& other, double silent_from) {
  return holds(one, other.tip) && holds(other, one.tip) && other.silent >= silent_from &&
         other.sent <= one.sent;
}

struct Count {
  std::size_t facing = 0;
  std::size_t found = 0;
};

// One listener among 203 others.
void ask(RandomStream& random, Vec2 middle, double base, double widest, Count& count) {
  Sectors sectors;
  sectors.clear(base);
  std::vector<Sector> all;
  for (std::uint64_t i = 0; i < 203; ++i)
    sectors.add(all.emplace_back(random_sector(random, middle, base, widest)), 1000 + i);
  const Sector one = random_sector(random, middle, base, widest);
  Sectors::Search search;
  const auto found = sectors.facing(one, one.sent - 0.01, one.sent, search);
  count.found += found.size();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto times = std::ranges::count(found, 1000 + i);
    CAPTURE(i, one.yaw, all[i].yaw);
    REQUIRE(times <= 1);
    if (!faces(one, all[i], one.sent - 0.01)) continue;
    ++count.facing;
    REQUIRE(times == 1);
  }
}

}  // namespace

TEST_CASE("no chirp that may be heard is left out, near the origin and far from it, late and early",
          "[sim][sonar]") {
  RandomStream random(5, "test", "sectors");
  const Vec2 middle = GENERATE(Vec2{0.0, 0.0}, Vec2{-3e4, 5e4});
  const double base = GENERATE(0.0, 86400.0);
  const double widest = GENERATE(0.25, 1.57);
  Count count;
  const std::size_t rounds = orca::test::part_of<std::size_t>(2000);
  for (std::size_t round = 0; round < rounds; ++round) ask(random, middle, base, widest, count);
  CAPTURE(count.facing, count.found);
  CHECK(count.facing > rounds / 10);      // there was something to find,
  CHECK(count.found < 2 * count.facing);  // and not much else was
}

TEST_CASE("sectors as wide as a half plane find each other once, in whichever direction they look",
          "[sim][sonar]") {
  for (int degrees = -175; degrees <= 180; degrees += 5) {
    const double yaw = degrees * kPi / 180.0;
    const Vec2 there = 3.0 * direction(yaw);
    Sectors sectors;
    sectors.clear(0.0);
    sectors.add(sector_at({there.x, there.y, wrapped(yaw + kPi)}, 0.5 * kPi, 0.0, 1.0), 7);
    const Sector one = sector_at({0, 0, yaw}, 0.5 * kPi, 0.0, 1.0);
    Sectors::Search search;
    const auto found = sectors.facing(one, 0.0, 1.0, search);
    CAPTURE(degrees);
    REQUIRE(std::vector<std::uint64_t>(found.begin(), found.end()) == std::vector<std::uint64_t>{7});
  }
}

TEST_CASE("an empty set of sectors faces nobody", "[sim][sonar]") {
  RandomStream random(6, "test", "sectors");
  Sectors sectors;
  sectors.clear(0.0);
  Sectors::Search search;
  CHECK(sectors.facing(random_sector(random, {}, 0.0, 0.7), -1.0, 1.0, search).empty());
}
