// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "orca/hw/nomad_scout/number.hpp"

using namespace orca::hw::nomad_scout;

TEST_CASE("signed numbers have a sign bit and a magnitude", "[hw][scout]") {
  CHECK(sign_and_magnitude(-50) == 0x8032);
  CHECK(from_sign_and_magnitude(0x8032) == -50);
  CHECK(from_sign_and_magnitude(0x7FFF) == 32767);
  CHECK(from_sign_and_magnitude(0xFFFF) == -32767);
}

TEST_CASE("a negative zero is zero", "[hw][scout]") {
  CHECK(from_sign_and_magnitude(0x8000) == 0);
  CHECK(from_long_sign_and_magnitude(0x80000000U) == 0);
  CHECK(sign_and_magnitude(0) == 0);
}

TEST_CASE("what does not fit is limited and keeps its sign", "[hw][scout]") {
  CHECK(sign_and_magnitude(40000) == 0x7FFF);
  CHECK(sign_and_magnitude(-40000) == 0xFFFF);
  CHECK(sign_and_magnitude(std::numeric_limits<int>::min()) == 0xFFFF);
  CHECK(long_sign_and_magnitude(std::numeric_limits<std::int64_t>::min()) == 0xFFFFFFFFU);
}

TEST_CASE("all signed numbers of 16 bits come back", "[hw][scout]") {
  int wrong = 0;
  for (int value = -32767; value <= 32767; ++value)
    wrong += from_sign_and_magnitude(sign_and_magnitude(value)) != value;
  CHECK(wrong == 0);
}

TEST_CASE("signed numbers of 32 bits come back", "[hw][scout]") {
  CHECK(long_sign_and_magnitude(-2) == 0x80000002U);
  for (const std::int32_t value : {0, 1, -1, 65536, -65537, 2147483647, -2147483647})
    CHECK(from_long_sign_and_magnitude(long_sign_and_magnitude(value)) == value);
}

TEST_CASE("lengths are in tenths of an inch, angles in tenths of a degree", "[hw][scout]") {
  CHECK(in_tenths_of_inch(0.254) == 100);
  CHECK(in_tenths_of_inch(-0.0013) == -1);
  CHECK(in_tenths_of_degree(std::numbers::pi / 2) == 900);
  CHECK(radians(-1800) == Approx(-std::numbers::pi));
}

TEST_CASE("what is no number counts as 0", "[hw][scout]") {
  CHECK(in_tenths_of_inch(std::nan("")) == 0);
  CHECK(in_tenths_of_degree(std::numeric_limits<double>::infinity()) == 0);
  CHECK(in_tenths_of_inch(1e12) == 32767);
}
