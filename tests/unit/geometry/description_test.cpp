// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "orca/geometry/objects/description.hpp"

using namespace orca;
using Catch::Contains;

namespace {

idl::Robot pioneer() {
  idl::Robot robot;
  robot.radius(0.26);
  robot.bumper_radius(0.31);
  robot.length(0.44);
  robot.width(0.38);
  robot.drives().emplace_back();
  robot.drives()[0].max_speed(1.8);
  robot.laser_sensors().emplace_back();
  robot.laser_sensors()[0].name() = "laser";
  robot.laser_sensors()[0].update_interval(0.2);
  return robot;
}

struct Wrong {
  std::string text;
  std::function<void(idl::Robot&)> spoil;
};

}  // namespace

TEST_CASE("a robot of some size is described, whatever else is not known", "[geometry]") {
  CHECK(check_description(pioneer()).ok());
  idl::Robot round;
  round.radius(0.01);
  CHECK(check_description(round).ok());
  round.sensors().emplace_back();
  round.sensors()[0].update_interval(300.0);  // of a battery, say
  CHECK(check_description(round).ok());
}

TEST_CASE("a description of no size, or with a figure that no robot has, is refused with that figure",
          "[geometry]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Wrong> all{
      {"its radius is 0 m", [](idl::Robot& robot) { robot.radius(0.0); }},
      {"its radius is -0.26 m", [](idl::Robot& robot) { robot.radius(-0.26); }},
      {"its radius is nan m", [&](idl::Robot& robot) { robot.radius(nan); }},
      {"its radius is 260 m; expected 0 to 50 m", [](idl::Robot& robot) { robot.radius(260.0); }},
      {"its bumper_radius is inf m", [&](idl::Robot& robot) { robot.bumper_radius(infinity); }},
      {"its length is -0.44 m", [](idl::Robot& robot) { robot.length(-0.44); }},
      {"its width is nan m", [&](idl::Robot& robot) { robot.width(nan); }},
      {"its max_speed is inf m/s", [&](idl::Robot& robot) { robot.drives()[0].max_speed(infinity); }},
      {"its max_steer_speed is nan rad/s",
       [&](idl::Robot& robot) { robot.drives()[0].max_steer_speed(nan); }},
      {"its speed_change is -1 m/s2", [](idl::Robot& robot) { robot.drives()[0].speed_change(-1.0); }},
      {"its sensor \"laser\"'s update_interval is 200 s; expected 0 to 60 s",
       [](idl::Robot& robot) { robot.laser_sensors()[0].update_interval(200.0); }}};
  for (const Wrong& wrong : all) {
    idl::Robot robot = pioneer();
    wrong.spoil(robot);
    const Status checked = check_description(robot);
    CAPTURE(wrong.text);
    REQUIRE_FALSE(checked.ok());
    CHECK_THAT(checked.error().message, Contains(wrong.text));
  }
}
