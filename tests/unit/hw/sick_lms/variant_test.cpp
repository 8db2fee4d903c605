// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <numbers>
#include <vector>

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

TEST_CASE("whole scans have the sizes of the telegram listing", "[hw][sick]") {
  CHECK(scan_size(181) == 372);
  CHECK(scan_size(361) == 732);
  CHECK(scan_size(401) == 812);
}

TEST_CASE("a scan takes ten bits per byte on the line", "[hw][sick]") {
  struct Row {
    std::size_t bytes;
    unsigned baud;
    double milliseconds;
  };
  for (const Row& row : std::vector<Row>{{372, 9600, 387.5},
                                         {372, 19200, 193.8},
                                         {372, 38400, 96.9},
                                         {372, 500000, 7.4},
                                         {732, 9600, 762.5},
                                         {732, 19200, 381.2},
                                         {732, 38400, 190.6},
                                         {732, 500000, 14.6},
                                         {812, 9600, 845.8},
                                         {812, 19200, 422.9},
                                         {812, 38400, 211.5},
                                         {812, 500000, 16.2}}) {
    INFO(row.bytes << " bytes at " << row.baud);
    CHECK(1000 * orca::to_seconds(line_time(row.bytes, row.baud)) == Approx(row.milliseconds).margin(0.0501));
  }
}

TEST_CASE("finer resolutions need more turns of the mirror", "[hw][sick]") {
  CHECK(orca::to_seconds(mirror_time({180, 100})) == Approx(0.013333).margin(1e-6));
  CHECK(orca::to_seconds(mirror_time({180, 50})) == Approx(0.026667).margin(1e-6));
  CHECK(orca::to_seconds(mirror_time({100, 25})) == Approx(0.053333).margin(1e-6));
}

TEST_CASE("on a slow line the line decides how often scans come, on a fast one the mirror", "[hw][sick]") {
  CHECK(scan_period({180, 100}, 38400) == line_time(372, 38400));
  CHECK(scan_period({180, 100}, 500000) == mirror_time({180, 100}));
}
