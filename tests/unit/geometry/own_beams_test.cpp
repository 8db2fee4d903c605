// SPDX-License-Identifier: GPL-3.0-or-later
// Which sensors look ahead.
#include <catch2/catch.hpp>

#include <vector>

#include "orca/geometry/objects/own_beams.hpp"
#include "rounding.hpp"

using namespace orca;
using Catch::Contains;
using test::kPi;

namespace {

constexpr double kDegree = kPi / 180.0;

// A laser whose frame is turned from the robot's by `yaw` [rad].
idl::LaserRangeReadings scan_of(double yaw, double first, double step, std::size_t beams) {
  idl::LaserRangeReadings scan;
  scan.pose().rotation().yaw(yaw);
  scan.angle_start(first);
  scan.angle_increment(step);
  scan.ranges().assign(beams, 1.0F);
  return scan;
}

idl::SonarRangeReadings ring_of(const std::vector<double>& degrees) {
  idl::SonarRangeReadings round;
  for (const double angle : degrees) {
    round.ranges().push_back(1.0F);
    round.poses().emplace_back();
    round.poses().back().rotation().yaw(angle * kDegree);
  }
  return round;
}

}  // namespace

TEST_CASE("a laser looks ahead wherever its angles begin and whichever way they go", "[geometry]") {
  CHECK(check_looks_ahead(scan_of(0.0, -kPi / 2.0, kDegree, 181)).ok());
  CHECK(check_looks_ahead(scan_of(0.0, kPi / 2.0, -kDegree, 181)).ok());
  CHECK(check_looks_ahead(scan_of(0.0, 0.0, kDegree, 360)).ok());
  CHECK(check_looks_ahead(scan_of(0.0, 2.0 * kPi, -kDegree, 20)).ok());
  CHECK(check_looks_ahead(scan_of(kPi, kPi / 2.0, kDegree, 181)).ok());
  CHECK(check_looks_ahead(scan_of(kPi / 2.0, -kPi / 2.0, kDegree, 61)).ok());
}

TEST_CASE("a laser that looks aside or to the back only is named with what to correct", "[geometry]") {
  for (const auto& scan : {scan_of(kPi, -kPi / 2.0, kDegree, 181), scan_of(kPi / 2.0, -0.5, kDegree, 58),
                           scan_of(0.0, kPi / 2.0, kDegree, 181)}) {
    const Status checked = check_looks_ahead(scan);
    REQUIRE_FALSE(checked.ok());
    CHECK_THAT(checked.error().message, Contains("none of its beams") && Contains("the rpy of its joint"));
  }
}

TEST_CASE("a ring looks ahead if one of its sonars is at most 30 degrees aside", "[geometry]") {
  CHECK(check_looks_ahead(ring_of({0.0, 90.0, 180.0, -90.0})).ok());
  CHECK(check_looks_ahead(ring_of({30.0, 90.0, 150.0, 210.0, 270.0, 330.0})).ok());
  CHECK(check_looks_ahead(ring_of({330.0})).ok());  // by rounding a little more than 30 degrees
  CHECK_THAT(check_looks_ahead(ring_of({45.0, -45.0, 135.0, -135.0})).error().message,
             Contains("none of its sonars") && Contains("first_angle"));
}
