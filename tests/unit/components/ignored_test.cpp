// SPDX-License-Identifier: GPL-3.0-or-later
// The beams that a LaserServer leaves out.
#include "laser_server/ignored.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace orca;
using Catch::Contains;
using laser::Ignored;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// A beam in each whole direction from -90 to 90 deg, of 1 m, at the robot's centre.
idl::LaserRangeReadings scan_of(double range = 1.0) {
  idl::LaserRangeReadings scan;
  scan.ranges(std::vector<double>(181, range));
  scan.max_range(8.0);
  scan.angle_start(-90 * kDegree);
  scan.angle_increment(kDegree);
  return scan;
}

// Returns the first and the last beam that is left out [deg], and how many are.
struct Gap {
  int first = 999;
  int last = -999;
  std::size_t count = 0;
  friend bool operator==(const Gap&, const Gap&) = default;
};
Gap gap_of(const std::vector<std::string>& texts, idl::LaserRangeReadings scan,
           const RobotOutline& robot = {}) {
  const Result<Ignored> ignored = Ignored::parse(texts);
  REQUIRE(ignored);
  Gap gap;
  gap.count = ignored->leave_out(scan, robot);
  for (int i = 0; i < 181; ++i) {
    if (!std::isnan(scan.ranges()[static_cast<std::size_t>(i)])) continue;
    gap.first = std::min(gap.first, i - 90);
    gap.last = std::max(gap.last, i - 90);
  }
  return gap;
}

}  // namespace

TEST_CASE("a sector of a scan is left out, over the back, too", "[laser][ignore]") {
  CHECK(gap_of({"sector -20 10"}, scan_of()) == Gap{-20, 10, 31});
  CHECK(gap_of({"sector 80 270"}, scan_of()) == Gap{-90, 90, 12});
  CHECK(gap_of({"sector -5 -3", "sector 3 5"}, scan_of()).count == 6);
}

TEST_CASE("what ends in a box or within the robot's outline is left out", "[laser][ignore]") {
  CHECK(gap_of({"box 0.9 -0.01 1.1 0.01"}, scan_of()) == Gap{0, 0, 1});
  CHECK(gap_of({"box 1.1 0.01 0.9 -0.01"}, scan_of(2.0)).count == 0);
  CHECK(gap_of({"outline"}, scan_of(0.2), {.radius = 0.3}).count == 181);
  CHECK(gap_of({"outline"}, scan_of(0.2), {.radius = 0.3, .length = 0.6, .width = 0.3}).count < 181);
  CHECK(gap_of({"outline"}, scan_of(0.32), {.radius = 0.3, .length = 0.6, .width = 0.5}).count == 0);
  CHECK(gap_of({"outline"}, scan_of(0.32), {.length = 0.6, .width = 0.5}).count > 0);
  CHECK(gap_of({"outline"}, scan_of(), {.radius = 0.3}).count == 0);
}

TEST_CASE("what is left out must be readable, and the error says what is expected", "[laser][ignore]") {
  for (const char* text :
       {"sector 1", "sector 1 2 3", "box 1 2 3", "sektor 1 2", "", "outline 1", "sector a b"}) {
    CAPTURE(text);
    const Result<Ignored> ignored = Ignored::parse({text});
    REQUIRE_FALSE(ignored);
    CHECK_THAT(ignored.error().message, Contains("\"sector FROM TO\" in degrees"));
  }
}

TEST_CASE("the beams that hold a robot are said by their number and angles", "[laser][ignore]") {
  idl::LaserRangeReadings scan = scan_of();
  scan.min_range(0.02);
  CHECK(beams_at_robot(scan, {.radius = 0.3}).empty());
  for (const std::size_t i : {100, 101, 102}) scan.ranges()[i] = 0.0;
  scan.ranges()[0] = 0.2;
  scan.ranges()[50] = std::nan("");
  CHECK_THAT(beams_at_robot(scan, {.radius = 0.3}),
             Contains("3 of its 181 beams, from 10 to 12 deg, are nearer than 0.02 m") &&
                 Contains("1 of its 181 beams, from -90 to -90 deg, end within the robot's own outline"));
}
