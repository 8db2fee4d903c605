// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>

#include "orca/base/random.hpp"
#include "orca/hw/nomad_scout/number.hpp"
#include "orca/hw/nomad_scout/odometry.hpp"

using namespace orca::hw::nomad_scout;
using orca::Vec2;

TEST_CASE("the first position of a Scout is only a reference", "[hw][scout]") {
  ScoutOdometry odometry;
  CHECK(odometry.add({122, 6}) == Vec2{0.0, 0.0});
  const Vec2 way = odometry.add({222, -94});
  CHECK(way.x == Approx(0.254));
  CHECK(way.y == Approx(-0.254));
}

TEST_CASE("a wrap at the end of 16 bits is a small step", "[hw][scout]") {
  CHECK(step_of(32760, -32766) == 10);
  CHECK(step_of(-32766, 32760) == -10);
  CHECK(step_of(32767, 32767) == 0);
  CHECK(step_of(-16000, 16000) == 32000);
}

TEST_CASE("after a new connection the position is a new reference", "[hw][scout]") {
  ScoutOdometry odometry;
  odometry.add({1, 1});
  odometry.forget();
  CHECK(odometry.add({5000, -5000}) == Vec2{0.0, 0.0});
}

TEST_CASE("a long way of a Scout is the sum of its steps", "[hw][scout]") {
  orca::RandomStream random(1, "test", "scout odometry");
  ScoutOdometry odometry;
  odometry.add({0, 0});
  long x = 0;
  double total = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    x += std::lround(random.uniform(-300, 500));
    const long wrapped_x = (x + 32768) % 65536 - 32768;  // as 16 bits would count; x only grows
    total += odometry.add({static_cast<int>(wrapped_x), 0}).x;
  }
  CHECK(total == Approx(static_cast<double>(x) * kLengthUnit));
  CHECK(x > 900'000);
}
