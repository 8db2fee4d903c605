// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/create2/odometry.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace orca::hw::create2;

TEST_CASE("123 counts are 123 * (pi * 72 mm / 508.8) = 54.7 mm", "[hw][create2]") {
  CHECK(wheel_way(123) == Approx(0.0547).margin(0.00005));
  CHECK(wheel_way(-123) == -wheel_way(123));
}

TEST_CASE("counts wrap at 16 bits in both directions", "[hw][create2]") {
  CHECK(step_of(65535, 0) == 1);
  CHECK(step_of(0, 65535) == -1);
  CHECK(step_of(65000, 100) == 636);
  CHECK(step_of(0, 32767) == 32767);
  CHECK(step_of(0, 32768) == -32768);
  CHECK(step_of(1234, 1234) == 0);
}

TEST_CASE("the first counts are a reference alone", "[hw][create2]") {
  EncoderOdometry odometry;
  CHECK(odometry.add(1000, 2000) == orca::Travel2{});
  CHECK(odometry.add(1123, 2123).forward == Approx(0.0547).margin(0.00005));
  odometry.forget();
  CHECK(odometry.add(0, 0) == orca::Travel2{});
}

TEST_CASE("equal counts are a straight way, opposite ones a turn", "[hw][create2]") {
  EncoderOdometry odometry;
  odometry.add(65500, 100);
  const auto straight = odometry.add(65500 + 509 - 65536, 609);
  CHECK(straight.forward == Approx(std::numbers::pi * 0.072).epsilon(0.001));
  CHECK(straight.turn == Approx(0.0).margin(1e-12));
  const auto left = odometry.add(static_cast<std::uint16_t>(473 - 415), 609 + 415);
  CHECK(left.forward == Approx(0.0).margin(1e-12));
  CHECK(left.turn ==
        Approx(std::numbers::pi / 2.0).epsilon(0.001));  // a quarter turn: pi * 0.235 / 4 per wheel
  CHECK(left.left == 0.0);
}

TEST_CASE("the way is the same in one step or in many, over many wraps", "[hw][create2]") {
  EncoderOdometry odometry;
  double way = 0.0;
  for (unsigned counts = 0; counts <= 1'000'000; counts += 1000)
    way += odometry.add(static_cast<std::uint16_t>(counts), static_cast<std::uint16_t>(counts)).forward;
  CHECK(way == Approx(1'000'000 / 508.8 * std::numbers::pi * 0.072));
}
