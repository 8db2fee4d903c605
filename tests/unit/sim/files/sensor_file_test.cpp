// SPDX-License-Identifier: GPL-3.0-or-later
// <laser>, <infrared_ring> and <bumper_ring> in a robot file.
#include <catch2/catch.hpp>

#include "orca/sim/robot_file.hpp"
#include "scout.hpp"

using namespace orca::sim;
using namespace orca::sim::test;

namespace {

const std::string kLaser =
    R"x(<laser name="laser" link="mast" count="361" first_angle="-90 deg" pitch="0.5 deg" max_range="8 m"
             quantum="10 mm" divergence="0.25 deg" period="100 ms" sweep="20 ms"/>)x";
const std::string kInfrared =
    R"x(<infrared_ring name="ir" link="mast" count="16" pitch="22.5 deg" half_beam="3 deg" max_range="0.8 m"
             period="50 ms"/>)x";
const std::string kBumper = R"x(<bumper_ring name="bumper" count="8" pitch="45 deg" period="20 ms"/>)x";
const std::string kSonar =
    R"x(<sonar_ring name="sonar" link="mast" count="4" pitch="90 deg" half_lobe="10 deg" min_range="0.1 m"
             max_range="5 m" period="200 ms" parallel="2"/>)x";

std::string robot(const std::string& devices) {
  return R"x(<robot name="r">
<link name="base"><inertial><mass value="10"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<collision><geometry><cylinder radius="0.2" length="0.3"/></geometry></collision></link>
<link name="mast"/>
<joint name="up" type="fixed"><parent link="base"/><child link="mast"/><origin xyz="0.1 0 0.4" rpy="0 0 0.5"/></joint>
<orca radius="0.2 m" bumper_radius="0.22 m"><drive type="differential" max_speed="1 m/s" max_steer_speed="1 rad/s"
 max_acceleration="1 m/s2" max_steer_acceleration="1 rad/s2" track="0.3 m" wheel_diameter="0.1 m"/>
)x" + devices +
         "</orca></robot>";
}

std::optional<RobotModel> read(const std::string& devices, std::string& errors) {
  orca::xml::Diagnostics diagnostics;
  auto model = read_robot_text(robot(devices), "r.urdf", diagnostics);
  errors = diagnostics.text();
  return model;
}

std::string errors_in(const std::string& devices) {
  std::string errors;
  CHECK_FALSE(read(devices, errors));
  return errors;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("laser, infrared ring and bumper ring come from the robot's file", "[sim][robot_file]") {
  std::string errors;
  const auto model = read(kLaser + kInfrared + kBumper + kSonar, errors);
  INFO(errors);
  REQUIRE(model);
  const LaserScanner& laser = model->lasers.at(0);
  CHECK(laser.count == 361);
  CHECK(laser.first_angle == Approx(-90.0 * kDegree));
  CHECK(laser.pitch == Approx(0.5 * kDegree));
  CHECK(laser.sweep == std::chrono::milliseconds{20});
  CHECK(laser.center.x == Approx(0.1));
  CHECK(laser.center.yaw == Approx(0.5));
  CHECK(laser.height == Approx(0.4));
  CHECK(model->infrareds.at(0).height == Approx(0.4));
  CHECK(model->infrareds.at(0).sensor(0).x == Approx(0.1 + 0.2 * std::cos(0.5)));
  CHECK(model->bumpers.at(0).radius == Approx(0.22));
  CHECK(model->bumpers.at(0).segment(2).y == Approx(0.22));
  CHECK(model->sonars.at(0).parallel == 2);
}

TEST_CASE("a bumper ring may list the directions of its segments", "[sim][robot_file]") {
  std::string errors;
  const auto model = read(replaced(kBumper, "count=\"8\"", "count=\"3\" angles=\"30 0 -120 deg\""), errors);
  INFO(errors);
  REQUIRE(model);
  CHECK(model->bumpers.at(0).segment(2).yaw == Approx(-120.0 * kDegree));
}

TEST_CASE("wrong lasers are reported at their place", "[sim][robot_file]") {
  const auto laser = [](const std::string& from, const std::string& to) {
    return errors_in(replaced(kLaser, from, to));
  };
  CHECK_THAT(laser("mast", "mats"),
             Catch::Contains("R012: there is no link \"mats\"; did you mean \"mast\"?"));
  CHECK_THAT(laser("361", "0"),
             Catch::Contains("error R005: count: \"0\" is out of range: 1 to 10000 is allowed"));
  CHECK_THAT(laser("\"0.5 deg\"", "\"0.5 m\""), Catch::Contains("error R005: pitch: \"0.5 m\""));
  CHECK_THAT(laser("max_range=\"8 m\"", ""),
             Catch::Contains("R004: <laser> needs the attribute \"max_range\""));
  CHECK_THAT(laser("sweep=\"20 ms\"", "sweep=\"120 ms\""),
             Catch::Contains("error R022: the sweep of one scan cannot take longer than the period"));
  CHECK_THAT(laser("\"0.5 deg\"", "\"0.5\""),
             Catch::Contains("error R022: all beams together must span at most two turns; an angle without a "
                             "unit is in radians"));
  CHECK_THAT(laser("10 mm", "10"), Catch::Contains("error R022: quantum must be less than max_range"));
  CHECK_THAT(laser("8 m", "8000"), Catch::Contains("error R022: max_range must be at most 1000 m"));
  CHECK_THAT(laser("0.25 deg", "100 deg"), Catch::Contains("error R022: divergence must be at most 90 deg"));
  CHECK_THAT(laser("100 ms", "1 ms"), Catch::Contains("error R022: the period must be between"));
  CHECK_THAT(laser("quantum", "quantun"), Catch::Contains("did you mean \"quantum\"?"));
}

TEST_CASE("wrong infrared and bumper rings are reported at their place", "[sim][robot_file]") {
  CHECK_THAT(errors_in(replaced(kInfrared, "3 deg", "95 deg")),
             Catch::Contains("error R022: half_beam must be at most 90 deg"));
  CHECK_THAT(errors_in(replaced(kInfrared, "max_range=\"0.8 m\"", "max_range=\"0.8 m\" min_range=\"1 m\"")),
             Catch::Contains("error R022: min_range must be less than max_range"));
  CHECK_THAT(errors_in(replaced(kBumper, "45 deg", "46 deg")),
             Catch::Contains("error R022: the segments are wider than a full turn together"));
  CHECK_THAT(errors_in(replaced(kBumper, "20 ms", "-1 s")), Catch::Contains("error R005: period"));
  CHECK_THAT(errors_in(replaced(kBumper, "pitch", "first_angle=\"1 deg\" angles=\"1 2 3 4 5 6 7 8\" pitch")),
             Catch::Contains("error R022: the directions are given by angles already"));
  CHECK_THAT(errors_in(replaced(kBumper, "pitch", "angles=\"1 2\" pitch")),
             Catch::Contains("error R005: angles"));
  CHECK_THAT(errors_in(replaced(kSonar, "parallel=\"2\"", "parallel=\"5\"")),
             Catch::Contains("error R005: parallel: \"5\" is out of range: 1 to 4 is allowed"));
}

TEST_CASE("devices of all kinds have names of their own", "[sim][robot_file]") {
  CHECK_THAT(errors_in(kLaser + replaced(kInfrared, "\"ir\"", "\"laser\"")),
             Catch::Contains("error R010: there is a laser \"laser\" already; choose another name"));
  CHECK_THAT(errors_in(kBumper + kBumper), Catch::Contains("error R010: there is a bumper ring \"bumper\""));
  CHECK_THAT(errors_in(replaced(kLaser, "\"laser\"", "\"odometry\"")), Catch::Contains("error R010"));
}

TEST_CASE("a robot's file guesses the errors of its ranges and wheels, in general and per level of realism",
          "[sim][robot_file]") {
  const std::string guesses =
      R"x(<range_errors fixed="10 mm" share="2 %"/><range_errors realism="harsh" fixed="3 cm" share="0"/>)x";
  const std::string wheels =
      R"x(<odometry period="50 ms"><wheel_errors realism="nominal" wheel_diameter="0.3 %" track="0.6 %"
    slip="3 mm"/><wheel_errors realism="recorded" wheel_diameter="3 %" track="1 %" slip="7.5 mm"/></odometry>)x";
  std::string errors;
  const auto model = read(replaced(kLaser, "/>", ">" + guesses + "</laser>") + kSonar + wheels, errors);
  INFO(errors);
  REQUIRE(model);
  CHECK(model->lasers.at(0).errors.at(Realism::ideal) == orca::RangeErrorGuess{0.01, 0.02});
  CHECK(model->lasers.at(0).errors.at(Realism::nominal) == orca::RangeErrorGuess{0.01, 0.02});
  CHECK(model->lasers.at(0).errors.at(Realism::harsh) == orca::RangeErrorGuess{0.03, 0.0});
  CHECK_FALSE(model->sonars.at(0).errors.at(Realism::nominal).is_known());
  CHECK(model->odometer->errors.at(Realism::nominal) == orca::WheelErrorGuess{0.003, 0.006, 0.003});
  CHECK(model->odometer->errors.at(Realism::recorded) == orca::WheelErrorGuess{0.03, 0.01, 0.0075});
  CHECK_FALSE(model->odometer->errors.at(Realism::harsh).is_known());
}

TEST_CASE("guesses that make no sense are reported at their place", "[sim][robot_file]") {
  const auto laser = [](const std::string& guesses) {
    return errors_in(replaced(kLaser, "/>", ">" + guesses + "</laser>"));
  };
  const std::string good = R"x(<range_errors fixed="10 mm" share="2 %"/>)x";
  CHECK_THAT(laser(good + good), Catch::Contains("error R010: there is a guess without realism already"));
  CHECK_THAT(laser(replaced(good, "10 mm", "-1 mm")), Catch::Contains("error R005: fixed: \"-1 mm\""));
  CHECK_THAT(laser(replaced(good, "10 mm", "9 m")),
             Catch::Contains("error R022: a sensor with an error as large as"));
  CHECK_THAT(laser(replaced(good, "2 %", "120 %")), Catch::Contains("error R005: share: \"120 %\""));
  CHECK_THAT(laser(R"x(<range_errors fixed="0" share="0"/>)x"), Catch::Contains("error R022: zeros mean"));
  CHECK_THAT(laser(R"x(<range_errors fixed="1 mm"/>)x"),
             Catch::Contains("R004: <range_errors> needs the attribute"));
  CHECK_THAT(laser(replaced(good, "fixed", "realism=\"hard\" fixed")),
             Catch::Contains("error R005: realism: \"hard\""));
  CHECK_THAT(laser(R"x(<wheel_errors wheel_diameter="1 %" track="1 %" slip="1 mm"/>)x"),
             Catch::Contains("error R002"));
  const std::string harsh =
      R"x(<wheel_errors realism="harsh" wheel_diameter="1 %" track="1 %" slip="1 mm"/>)x";
  CHECK_THAT(errors_in("<odometry period=\"50 ms\">" + harsh + harsh + "</odometry>"),
             Catch::Contains("error R010: there is a guess for realism \"harsh\" already"));
  CHECK_THAT(errors_in("<odometry period=\"50 ms\">" + replaced(harsh, "track=\"1 %\"", "track=\"1 m\"") +
                       "</odometry>"),
             Catch::Contains("error R005: track: \"1 m\""));
}
