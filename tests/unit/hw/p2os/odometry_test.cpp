// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>

#include "orca/base/random.hpp"
#include "orca/hw/p2os/odometry.hpp"

using namespace orca::hw;
using orca::Vec2;

TEST_CASE("the first coordinates of a Pioneer are only a reference", "[hw][p2os]") {
  p2os::WheelOdometry odometry(0.00084);
  CHECK(odometry.add(1190, 32649) == Vec2{0.0, 0.0});
  CHECK(odometry.add(1190, 32649) == Vec2{0.0, 0.0});
}

TEST_CASE("the way is the difference of coordinates in the model's unit", "[hw][p2os]") {
  p2os::WheelOdometry odometry(0.00084);
  odometry.add(0, 0);
  const Vec2 way = odometry.add(1190, 32649);
  CHECK(way.x == Approx(0.99960).epsilon(1e-9));
  CHECK(way.y == Approx(-0.09996).epsilon(1e-9));  // 32649 is -119
}

TEST_CASE("coordinates of 15 bits wrap", "[hw][p2os]") {
  CHECK(p2os::step_of(32700, 68) == 136);
  CHECK(p2os::step_of(68, 32700) == -136);
  CHECK(p2os::step_of(32767, 0) == 1);
  CHECK(p2os::step_of(0, 16383) == 16383);
  CHECK(p2os::step_of(0, 16384) == -16384);
  CHECK(p2os::step_of(0x8001, 0x0002) == 1);  // bit 15 does not count
}

TEST_CASE("after a new connection the coordinates are a new reference", "[hw][p2os]") {
  p2os::WheelOdometry odometry(0.001);
  odometry.add(100, 100);
  odometry.forget();
  CHECK(odometry.add(5000, 0) == Vec2{0.0, 0.0});
  CHECK(odometry.add(5001, 0) == Vec2{0.001, 0.0});
}

TEST_CASE("a long way in small steps is the sum of its steps, however often the coordinates wrap",
          "[hw][p2os]") {
  orca::RandomStream random(1, "test", "p2os odometry");
  p2os::WheelOdometry odometry(1.0);
  long x = 7;
  long y = -3;
  Vec2 total;
  odometry.add(static_cast<std::uint16_t>(x & 0x7FFF), static_cast<std::uint16_t>(y & 0x7FFF));
  for (int i = 0; i < 10'000; ++i) {
    x += std::lround(random.uniform(-2000, 16000));
    y += std::lround(random.uniform(-16000, 2000));
    total =
        total + odometry.add(static_cast<std::uint16_t>(x & 0x7FFF), static_cast<std::uint16_t>(y & 0x7FFF));
  }
  CHECK(total == Vec2{static_cast<double>(x - 7), static_cast<double>(y + 3)});
  CHECK(x > 50'000'000);
}
