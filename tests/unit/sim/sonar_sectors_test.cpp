// SPDX-License-Identifier: GPL-3.0-or-later
// The coarse question of which chirps a sonar may hear, against the exact one.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "orca/base/random.hpp"
#include "sonar_sectors.hpp"

using namespace orca;
using namespace orca::sim;
using detail::Sector;
using detail::Sectors;

namespace {

// A sector with what it was made of.
struct Fan {
  double yaw, half_angle, reach;
  Sector sector;

  [[nodiscard]] bool holds(Vec2 point) const {
    const Vec2 to = point - sector.tip;
    return norm(to) <= reach && std::fabs(wrapped(std::atan2(to.y, to.x) - yaw)) <= half_angle;
  }
};

// As the air makes them: the circle around a narrow sector is smaller than that around its tip.
Fan random_fan(RandomStream& random, double widest) {
  const double yaw = random.uniform(-3.14, 3.14);
  const double half_angle = random.uniform(0.05, widest);
  const double reach = random.uniform(0.2, 6.0);
  const Vec2 tip{random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0)};
  const double radius = 0.5 * reach / std::cos(half_angle);
  const bool narrow = half_angle < 0.78;
  const Circle around = narrow ? Circle{tip + radius * direction(yaw), radius} : Circle{tip, reach};
  const Sector sector{tip, direction(yaw + half_angle), direction(yaw - half_angle), around, 0.0, 1.0};
  return {yaw, half_angle, reach, sector};
}

Sector random_sector(RandomStream& random, Vec2 middle, double base) {
  const double yaw = random.uniform(-3.14, 3.14);
  const double half_angle = random.uniform(0.05, 0.7);
  const double reach = random.uniform(0.2, 6.0);
  const double sent = base + random.uniform(-0.04, 0.01);
  const Vec2 tip = middle + Vec2{random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0)};
  const double radius = 0.5 * reach / std::cos(half_angle);
  return {tip,
          direction(yaw + half_angle),
          direction(yaw - half_angle),
          {tip + radius * direction(yaw), radius},
          sent,
          sent + random.uniform(0.001, 0.04)};
}

bool lies_beside(const Circle& circle, const Sector& sector) {
  const Vec2 to = circle.center - sector.tip;
  return cross(sector.left, to) > circle.radius || cross(sector.right, to) < -circle.radius;
}

bool is_near(const Sector& one, const Sector& other, double silent_from, double sent_until) {
  return !lies_beside(one.around, other) && !lies_beside(other.around, one) && other.silent >= silent_from &&
         other.sent <= sent_until;
}

}  // namespace

TEST_CASE("no chirp that may be heard is left out, near the origin and far from it, late and early",
          "[sim][sonar]") {
  RandomStream random(5, "test", "sectors");
  const Vec2 middle = GENERATE(Vec2{0.0, 0.0}, Vec2{-3e4, 5e4});
  const double base = GENERATE(0.0, 86400.0);
  Sectors sectors;
  std::size_t near = 0;
  std::size_t found_in_all = 0;
  for (int round = 0; round < 200; ++round) {
    sectors.clear(base);
    std::vector<Sector> all;
    for (std::size_t i = 0; i < 203; ++i) sectors.add(all.emplace_back(random_sector(random, middle, base)));
    const Sector one = random_sector(random, middle, base);
    const double from = one.sent - 0.01;
    const auto found = sectors.near(one, from, one.sent);
    found_in_all += found.size();
    REQUIRE(std::ranges::is_sorted(found));
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      if (!is_near(one, all[i], from, one.sent)) continue;
      ++near;
      CAPTURE(round, i);
      REQUIRE(std::ranges::binary_search(found, i));
    }
  }
  CAPTURE(near, found_in_all);
  CHECK(near > 1000);                      // there was something to find,
  CHECK(found_in_all < near + near / 10);  // and little else was
}

TEST_CASE("sectors that have a point in common find each other, however wide they are", "[sim][sonar]") {
  RandomStream random(7, "test", "fans");
  int shared = 0;
  for (int round = 0; round < 300; ++round) {
    Sectors sectors;
    sectors.clear(0.0);
    std::vector<Fan> all;
    for (int i = 0; i < 50; ++i) sectors.add(all.emplace_back(random_fan(random, 1.57)).sector);
    const Fan one = random_fan(random, 1.57);
    const auto found = sectors.near(one.sector, 0.0, 1.0);
    for (int k = 0; k < 20; ++k) {
      const double angle = one.yaw + one.half_angle * random.uniform(-1.0, 1.0);
      const Vec2 point = one.sector.tip + one.reach * random.uniform(0.0, 1.0) * direction(angle);
      for (std::uint32_t i = 0; i < all.size(); ++i) {
        if (!all[i].holds(point)) continue;
        ++shared;
        CAPTURE(round, i);
        REQUIRE(std::ranges::binary_search(found, i));
      }
    }
  }
  CHECK(shared > 1000);
}

TEST_CASE("without any sector none is near", "[sim][sonar]") {
  RandomStream random(6, "test", "sectors");
  Sectors sectors;
  sectors.clear(0.0);
  CHECK(sectors.near(random_sector(random, {}, 0.0), -1.0, 1.0).empty());
}
