// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <numbers>

#include "orca/hw/sick_lms/variant.hpp"

using namespace orca::hw::sick_lms;

namespace {

constexpr double kDegreesOfBeam = std::numbers::pi / 180.0;

}  // namespace

TEST_CASE("variants have the numbers of beams of the telegram listing", "[hw][sick]") {
  CHECK(beams({100, 25}) == 401);
  CHECK(beams({100, 50}) == 201);
  CHECK(beams({100, 100}) == 101);
  CHECK(beams({180, 50}) == 361);
  CHECK(beams({180, 100}) == 181);
}

TEST_CASE("only the listed variants are possible", "[hw][sick]") {
  for (const Variant& variant : kVariants) CHECK(is_possible(variant));
  CHECK_FALSE(is_possible({180, 25}));
  CHECK_FALSE(is_possible({180, 0}));
  CHECK_FALSE(is_possible({0, 0}));
}

TEST_CASE("beams go from right to left, symmetric about straight ahead", "[hw][sick]") {
  for (const Variant& variant : kVariants) {
    const std::size_t last = beams(variant) - 1;
    CHECK(beam_angle(variant, 0) == Approx(-(variant.angle / 2.0) * kDegreesOfBeam));
    CHECK(beam_angle(variant, last / 2) == 0.0);
    CHECK(beam_angle(variant, last) == Approx(variant.angle / 2.0 * kDegreesOfBeam));
    CHECK(beam_angle(variant, 1) - beam_angle(variant, 0) == Approx(increment(variant)));
  }
  CHECK(increment({180, 50}) == Approx(0.5 * kDegreesOfBeam));
}
