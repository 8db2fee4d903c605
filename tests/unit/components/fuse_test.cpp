// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "motion_command_fuser/algorithm.hpp"
#include "orca/base/random.hpp"

using namespace orca::fuse;
using Catch::Detail::Approx;
using std::numbers::pi;

namespace {

constexpr double kGain = 1.5;

Wish heading(double direction, double speed, double weight) {
  return {Wish::Kind::direction, direction, speed, weight};
}
Wish turning(double rate, double speed, double weight) {
  return {Wish::Kind::turn_rate, rate, speed, weight};
}
Wish stop() { return {Wish::Kind::full_stop}; }

std::vector<Wish> random_wishes(orca::RandomStream& random, double widest) {
  std::vector<Wish> wishes(1 + random() % 6);
  for (Wish& wish : wishes)
    wish = heading(random.uniform(-widest, widest), random.uniform(-1.0, 1.0), random.uniform(0.1, 5.0));
  return wishes;
}

}  // namespace

TEST_CASE("no wish, or none with a weight, fuses to nothing", "[components][fuser]") {
  CHECK_FALSE(fuse_weighted({}, kGain).has_value());
  const std::vector weightless{heading(1.0, 0.5, 0.0), turning(0.3, 0.2, 0.0)};
  CHECK_FALSE(fuse_weighted(weightless, kGain).has_value());
}

TEST_CASE("one wish is fused to itself", "[components][fuser]") {
  const auto direction = fuse_weighted(std::vector{heading(-2.0, 0.5, 3.0)}, kGain);
  REQUIRE(direction);
  CHECK(direction->kind == Wish::Kind::direction);
  CHECK(direction->value == Approx(-2.0));
  CHECK(direction->speed == Approx(0.5));
  CHECK(direction->weight == 3.0);
  const auto rate = fuse_weighted(std::vector{turning(0.4, 0.1, 0.5)}, kGain);
  REQUIRE(rate);
  CHECK(rate->kind == Wish::Kind::turn_rate);
  CHECK(rate->value == Approx(0.4));
}

TEST_CASE("a full stop wins over any number of other wishes, wherever it stands and without weight",
          "[components][fuser]") {
  orca::RandomStream random(1, "test", "stop");
  for (int i = 0; i < 100; ++i) {
    std::vector<Wish> wishes = random_wishes(random, pi);
    wishes.insert(wishes.begin() + static_cast<long>(random() % (wishes.size() + 1)), stop());
    const auto fused = fuse_weighted(wishes, kGain);
    REQUIRE(fused);
    CHECK(fused->kind == Wish::Kind::full_stop);
  }
}

TEST_CASE("the heavier wish pulls the fused direction to its side", "[components][fuser]") {
  const auto even = fuse_weighted(std::vector{heading(0.5, 1.0, 1.0), heading(-0.5, 0.0, 1.0)}, kGain);
  REQUIRE(even);
  CHECK(even->value == Approx(0.0).margin(1e-12));
  CHECK(even->speed == Approx(0.5));
  const auto left = fuse_weighted(std::vector{heading(0.5, 1.0, 3.0), heading(-0.5, 0.0, 1.0)}, kGain);
  REQUIRE(left);
  CHECK(left->value > 0.2);
  CHECK(left->speed == Approx(0.75));
}

TEST_CASE("directions across the rear are fused over the rear, not over the front", "[components][fuser]") {
  const auto fused =
      fuse_weighted(std::vector{heading(pi - 0.1, 0.5, 1.0), heading(-pi + 0.1, 0.5, 1.0)}, kGain);
  REQUIRE(fused);
  CHECK(std::abs(fused->value) == Approx(pi));
}

TEST_CASE("the fused speed lies between the wishes and the fused direction within their cone",
          "[components][fuser]") {
  orca::RandomStream random(2, "test", "cone");
  for (int i = 0; i < 500; ++i) {
    const std::vector<Wish> wishes = random_wishes(random, 1.5);
    const auto fused = fuse_weighted(wishes, kGain);
    REQUIRE(fused);
    const auto by_speed = [](const Wish& a, const Wish& b) { return a.speed < b.speed; };
    const auto by_value = [](const Wish& a, const Wish& b) { return a.value < b.value; };
    const auto [slow, fast] = std::minmax_element(wishes.begin(), wishes.end(), by_speed);
    const auto [right, left] = std::minmax_element(wishes.begin(), wishes.end(), by_value);
    CHECK(fused->speed >= slow->speed - 1e-12);
    CHECK(fused->speed <= fast->speed + 1e-12);
    CHECK(fused->value >= right->value - 1e-12);
    CHECK(fused->value <= left->value + 1e-12);
  }
}

TEST_CASE("scaling all weights changes nothing but the weight", "[components][fuser]") {
  orca::RandomStream random(3, "test", "scale");
  for (int i = 0; i < 200; ++i) {
    std::vector<Wish> wishes = random_wishes(random, 1.5);
    const auto before = fuse_weighted(wishes, kGain);
    for (Wish& wish : wishes) wish.weight *= 8.0;
    const auto after = fuse_weighted(wishes, kGain);
    REQUIRE(before);
    REQUIRE(after);
    CHECK(after->value == Approx(before->value).margin(1e-9));
    CHECK(after->speed == Approx(before->speed).margin(1e-9));
    CHECK(after->weight == Approx(8.0 * before->weight));
  }
}

TEST_CASE("a direction beside a turn rate counts as a rate of the gain times the direction",
          "[components][fuser]") {
  const auto fused = fuse_weighted(std::vector{heading(0.4, 0.2, 1.0), turning(-0.2, 0.4, 3.0)}, kGain);
  REQUIRE(fused);
  CHECK(fused->kind == Wish::Kind::turn_rate);
  CHECK(fused->value == Approx((kGain * 0.4 - 3.0 * 0.2) / 4.0));
  CHECK(fused->speed == Approx((0.2 + 3.0 * 0.4) / 4.0));
  CHECK(fused->weight == 4.0);
}

TEST_CASE("a wish without weight is disregarded, also for the kind of the result", "[components][fuser]") {
  const auto fused = fuse_weighted(std::vector{heading(0.4, 0.2, 1.0), turning(9.0, 9.0, 0.0)}, kGain);
  REQUIRE(fused);
  CHECK(fused->kind == Wish::Kind::direction);
  CHECK(fused->value == Approx(0.4));
}

TEST_CASE("opposite directions of equal weight cancel out to a robot that stands", "[components][fuser]") {
  for (const double direction : {0.3, 1.0, pi / 2, 2.5}) {
    const auto fused =
        fuse_weighted(std::vector{heading(direction, 0.5, 1.0), heading(direction - pi, 0.5, 1.0)}, kGain);
    REQUIRE(fused);
    CHECK(fused->value == 0.0);
    CHECK(fused->speed == 0.0);
  }
}
