// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/sim/realism.hpp"

#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca;
using namespace orca::sim;
using Catch::Contains;

TEST_CASE("single errors of a level are multiplied, and nothing else changes", "[sim][errors]") {
  const ErrorLevels nominal = error_levels(Realism::nominal);
  const ErrorLevels scaled = sim::scaled(nominal, " slip=2; laser_bias = 0.5 ;").value();
  CHECK(scaled.slip == 2.0 * nominal.slip);
  CHECK(scaled.laser_bias == 0.5 * nominal.laser_bias);
  CHECK(scaled.turn_slip == nominal.turn_slip);
  CHECK(scaled.sonar_noise == nominal.sonar_noise);
  CHECK(sim::scaled(nominal, "").value().slip == nominal.slip);
}

TEST_CASE("estimates are multiplied at every level", "[sim][errors]") {
  for (const Realism level : {Realism::ideal, Realism::nominal, Realism::harsh, Realism::recorded}) {
    CHECK(error_levels(level).contact_friction == ErrorLevels{}.contact_friction);
    CHECK(sim::scaled(error_levels(level), "contact_friction=2").value().contact_friction == 0.32);
  }
  const ErrorLevels scaled = sim::scaled({}, "sonar_edges=5; sonar_threshold=20; sonar_in_line=100").value();
  CHECK(scaled.sonar_edges == 1.0);
  CHECK(scaled.sonar_threshold == 1.0);
  CHECK(scaled.sonar_in_line == Approx(0.5 * std::numbers::pi));
}

TEST_CASE("angles and probabilities stay what they are", "[sim][errors]") {
  const ErrorLevels scaled =
      sim::scaled(error_levels(Realism::harsh), "critical_angle=9; laser_drop_angle=2; sonar_outliers=50")
          .value();
  CHECK(scaled.critical_angle == Approx(0.5 * std::numbers::pi));
  CHECK(scaled.laser_drop_angle == Approx(0.5 * std::numbers::pi));
  CHECK(scaled.sonar_outliers == 1.0);
}

TEST_CASE("what is no error or no factor is refused with what is expected", "[sim][errors]") {
  const auto refusal = [](const char* factors) {
    return sim::scaled(error_levels(Realism::nominal), factors).error().message;
  };
  CHECK_THAT(refusal("slop=2"),
             Contains("\"slop\" is no error of a level and no estimate; there are: wheel_mismatch, ") &&
                 Contains("did you mean \"slip\"?"));
  CHECK_THAT(refusal("friction=2"), Contains("infrared_noise, slip_length, common_length, slip_angle, "
                                             "sonar_edges, sonar_threshold, sonar_in_line, laser_spot, "
                                             "contact_friction, wheel_grip, motor_force"));
  for (const char* bad : {"slip", "slip=", "slip=two", "slip=-1", "slip=1000", "slip=nan"})
    CHECK_THAT(refusal(bad), Contains("slip expects a factor from 0 to 100, as in slip=2"));
}

TEST_CASE("a world can have errors of its own instead of those of a level", "[sim][errors]") {
  const auto end_with = [](std::optional<ErrorLevels> errors) {
    World world({}, {.seed = 1, .realism = Realism::nominal, .errors = errors});
    const RobotId robot = world.add_robot("dewey", test::scout(), {}).value();
    REQUIRE(world.set_velocity_command(robot, {.forward = 0.4}));
    for (int i = 0; i < 200; ++i) world.step();
    return world.pose(robot);
  };
  const ErrorLevels nominal = error_levels(Realism::nominal);
  CHECK(end_with(nominal) == end_with(std::nullopt));
  CHECK(end_with(sim::scaled(nominal, "slip=2").value()) != end_with(std::nullopt));
}
