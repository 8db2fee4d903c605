// SPDX-License-Identifier: GPL-3.0-or-later
// What counts as a reading, and what is asked about a command.
#include "orca/idl/checks.hpp"

#include "orca/idl/moving.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace orca;
using Catch::Contains;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Readings>
Readings with_ranges(std::vector<double> ranges) {
  Readings readings;
  readings.ranges(std::move(ranges));
  readings.min_range(0.1);
  readings.max_range(8.0);
  return readings;
}

idl::LaserRangeReadings scan(std::vector<double> ranges = {1.0, 2.0, 3.0}) {
  auto readings = with_ranges<idl::LaserRangeReadings>(std::move(ranges));
  readings.angle_start(-0.5);
  readings.angle_increment(0.5);
  return readings;
}

idl::SonarRangeReadings sonar_round(std::vector<double> ranges = {1.0, 2.0}) {
  auto readings = with_ranges<idl::SonarRangeReadings>(std::move(ranges));
  readings.poses().resize(readings.ranges().size());
  return readings;
}

template <class Reading, class Change>
std::string fault_of(Reading reading, Change change) {
  change(reading);
  const Status checked = check_reading(reading);
  return checked.ok() ? "" : checked.error().message;
}

}  // namespace

TEST_CASE("a scan counts if one of its ranges is a number", "[idl][checks]") {
  CHECK(check_reading(scan()).ok());
  CHECK(check_reading(scan({kNaN, 2.0, kNaN})).ok());
  CHECK(check_reading(scan({8.0})).ok());
  CHECK(fault_of(scan(), [](auto& s) { s.ranges().clear(); }) == "it has no ranges");
  CHECK(fault_of(scan({kNaN, kNaN}), [](auto& /*s*/) {}) == "none of its 2 ranges is a number");
}

TEST_CASE("a scan of which all is out of range counts: nothing is seen, or something is too near",
          "[idl][checks]") {
  CHECK(check_reading(scan({kInfinity, kInfinity})).ok());
  CHECK(check_reading(scan({-kInfinity, 0.0})).ok());
}

TEST_CASE("a scan with angles, limits or a pose that no laser has counts as none", "[idl][checks]") {
  for (const double wrong : {kNaN, kInfinity, -kInfinity, 1e300}) {
    CAPTURE(wrong);
    CHECK_THAT(fault_of(scan(), [&](auto& s) { s.angle_increment(wrong); }), Contains("rad apart"));
    CHECK_THAT(fault_of(scan(), [&](auto& s) { s.angle_start(wrong); }), Contains("rad apart"));
    CHECK_THAT(fault_of(scan(), [&](auto& s) { s.time_increment(wrong); }), Contains("time_increment"));
    CHECK_THAT(fault_of(scan(), [&](auto& s) { s.min_range(wrong); }), Contains("min_range"));
    CHECK_THAT(fault_of(scan(), [&](auto& s) { s.max_range(wrong); }), Contains("max_range"));
    CHECK_THAT(fault_of(scan(), [&](auto& s) { s.pose().position().y(wrong); }), Contains("pose"));
    CHECK_THAT(fault_of(scan(), [&](auto& s) { s.pose().rotation().yaw(wrong); }), Contains("pose"));
  }
}

TEST_CASE(
    "a scan of a sensor that sees no farther than a hair, or is farther from its robot than any, counts as "
    "none",
    "[idl][checks]") {
  CHECK_THAT(fault_of(scan(), [](auto& s) { s.min_range(0.0), s.max_range(1e-310); }), Contains("max_range"));
  CHECK_THAT(fault_of(scan(), [](auto& s) { s.min_range(0.0), s.max_range(0.05); }), Contains("from 0.1 m"));
  CHECK_THAT(fault_of(scan(), [](auto& s) { s.pose().position().x(210.0); }), Contains("in metres"));
  CHECK_THAT(fault_of(sonar_round(),
                      [](auto& round) {
                        for (auto& pose : round.poses()) pose.position().y(-210.0);
                      }),
             Contains("finite pose"));
}

TEST_CASE("a scan whose beams are all one, or more than two turns, counts as none", "[idl][checks]") {
  CHECK_THAT(fault_of(scan(), [](auto& s) { s.angle_increment(0.0); }), Contains("angles that differ"));
  CHECK_THAT(fault_of(scan(), [](auto& s) { s.angle_increment(1e-310); }), Contains("angles that differ"));
  CHECK_THAT(fault_of(scan(std::vector<double>(181, 1.0)), [](auto& s) { s.angle_increment(1.0); }),
             Contains("at most two turns"));
  CHECK(fault_of(scan({1.0}), [](auto& s) { s.angle_increment(0.0); }).empty());
}

TEST_CASE("readings whose range limits leave nothing between them count as none", "[idl][checks]") {
  CHECK_THAT(fault_of(scan(), [](auto& s) { s.max_range(0.0); }), Contains("max_range 0 m"));
  CHECK_THAT(fault_of(scan(), [](auto& s) { s.max_range(0.05); }), Contains("min_range < max_range"));
  CHECK_THAT(fault_of(sonar_round(), [](auto& r) { r.min_range(-1.0); }), Contains("min_range -1 m"));
}

TEST_CASE("readings in millimetres count as none, by their limits or by what is far beyond them",
          "[idl][checks]") {
  CHECK_THAT(fault_of(scan(), [](auto& s) { s.max_range(8000.0); }), Contains("max_range 8000 m"));
  CHECK_THAT(fault_of(scan({900.0, 2000.0}), [](auto& /*s*/) {}), Contains("in millimetres?"));
  CHECK_THAT(fault_of(sonar_round({kNaN, 300.0, 1e5}), [](auto& /*r*/) {}), Contains("in millimetres?"));
  // A number for "no echo", whatever it is.
  CHECK(check_reading(scan({8190.0, 1.0, 8190.0, kInfinity})).ok());
  CHECK(check_reading(scan({70.0, 79.0})).ok());
}

TEST_CASE("a scan of a laser that does not lie level counts as none", "[idl][checks]") {
  const auto tilted = [](double roll, double pitch) {
    return fault_of(scan(),
                    [&](auto& s) { s.pose().rotation().roll(roll), s.pose().rotation().pitch(pitch); });
  };
  CHECK(tilted(0.2, -0.2).empty());
  CHECK(tilted(3.1416, 3.1416).empty());  // turned round
  CHECK_THAT(tilted(3.1416, 0.0), Contains("upside down"));
  CHECK_THAT(tilted(0.0, -1.57), Contains("a pitch of -1.57 rad"));
}

TEST_CASE("a sonar round counts if one range is a number and its sonar has a pose", "[idl][checks]") {
  CHECK(check_reading(sonar_round()).ok());
  CHECK(check_reading(sonar_round({kNaN, 1.0})).ok());
  CHECK_THAT(fault_of(sonar_round(), [](auto& r) { r.poses().clear(); }), Contains("it has 0 poses"));
  CHECK(fault_of(sonar_round(), [](auto& r) { r.poses()[0].position().x(kNaN); }).empty());
  CHECK_THAT(fault_of(sonar_round({1.0, kNaN}), [](auto& r) { r.poses()[0].position().x(kNaN); }),
             Contains("finite pose"));
}

TEST_CASE("a pose or odometry with a number that is not finite counts as none, and the number is named",
          "[idl][checks]") {
  CHECK(check_reading(idl::RobotPose()).ok());
  CHECK(check_reading(idl::Odometry()).ok());
  CHECK(fault_of(idl::RobotPose(), [](auto& p) { p.orientation(kNaN); }) ==
        "its orientation is nan; expected at most 1e7");
  CHECK_THAT(fault_of(idl::RobotPose(), [](auto& p) { p.x(1e300); }), Contains("its x is 1e+300"));
  CHECK_THAT(fault_of(idl::Odometry(), [](auto& o) { o.steering_velocity(-kInfinity); }),
             Contains("its steering_velocity is -inf"));
  CHECK_THAT(fault_of(idl::Odometry(), [](auto& o) { o.covariance()[1] = kNaN; }), Contains("not finite"));
  CHECK_THAT(fault_of(idl::RobotPose(), [](auto& p) { p.covariance()[8] = -1.0; }),
             Contains("negative variance"));
}

TEST_CASE("a command beyond what robots do is asked about, with the likely mistake", "[idl][checks]") {
  CHECK_FALSE(doubt_about(*turn(8.7, 2.2)));
  CHECK_FALSE(doubt_about(*head(-3.14, 0.5)));
  CHECK_FALSE(doubt_about(*full_stop()));
  CHECK_THAT(doubt_about(*turn(90.0, 0.5)).value_or(""), Contains("90 rad/s: did you mean degrees?"));
  CHECK_THAT(doubt_about(*head(45.0, 0.5)).value_or(""), Contains("45 rad: did you mean degrees?"));
  CHECK_THAT(doubt_about(*turn(0.0, -250.0)).value_or(""), Contains("-250 m/s: was it meant in mm/s"));
  idl::HolonomicVelocity sideways;
  sideways.left(300.0);
  CHECK_THAT(doubt_about(sideways).value_or(""), Contains("300 m/s"));
}

TEST_CASE("of things that move each number must be possible", "[idl][checks]") {
  idl::MovingThings moving;
  CHECK(check_reading(moving).ok());
  moving.things().resize(1);
  moving.things()[0].number(7);
  CHECK(check_reading(moving).ok());
  CHECK(fault_of(moving, [](auto& m) { m.things()[0].velocity_y(kNaN); }) ==
        "velocity_y of its thing 7 is nan; expected at most 1e7");
  CHECK(fault_of(moving, [](auto& m) { m.things()[0].radius(-0.1); }) ==
        "radius of its thing 7 is -0.1; expected 0 to 1e7");
  CHECK(fault_of(moving, [](auto& m) { m.things()[0].unseen(kInfinity); }) ==
        "unseen of its thing 7 is inf; expected 0 to 1e7");
}
