// SPDX-License-Identifier: GPL-3.0-or-later
// What the simulated hardware publishes of its uncertainty comes from the robot's file.
#include <catch2/catch.hpp>

#include "shipped.hpp"
#include "sim_sensors.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;

namespace {

template <class Object>
ObjectPtr<Object> latest(SimSensors& sensors) {
  for (const hw::SensorEndpoint* endpoint : sensors.endpoints())
    if (endpoint->type().name == object_type<Object>().name) return object_cast<Object>(endpoint->latest());
  FAIL("the robot has no such sensor");
  return {};
}

SharedWorld::Inbox scan_of(const std::vector<double>& ranges) {
  SharedWorld::Inbox inbox;
  inbox.laser.emplace_back(0, LaserScan{{}, ranges, {}});
  return inbox;
}

SharedWorld::Inbox rolled_to(double x) {
  SharedWorld::Inbox inbox;
  inbox.odometry.push_back({{}, {x, 0.0, 0.0}, {}});
  return inbox;
}

}  // namespace

TEST_CASE("each range comes with the uncertainty that the robot's file guesses for the level",
          "[sim][uncertainty]") {
  RobotModel model = shipped("pioneer_2dx");
  model.lasers.at(0).errors = {};
  REQUIRE(model.lasers.at(0).errors.set(std::nullopt, RangeErrorGuess{0.03, 0.01}));
  REQUIRE(model.lasers.at(0).errors.set(Realism::harsh, RangeErrorGuess{0.05, 0.0}));
  SimSensors nominal(model, Realism::nominal);
  nominal.publish(scan_of({0.0, 4.0}));
  CHECK(latest<idl::LaserRangeReadings>(nominal)->ranges_uncertainty() == std::vector<double>{0.03, 0.05});
  SimSensors harsh(model, Realism::harsh);
  harsh.publish(scan_of({0.0, 4.0}));
  CHECK(latest<idl::LaserRangeReadings>(harsh)->ranges_uncertainty() == std::vector<double>{0.05, 0.05});
}

TEST_CASE("what a robot's file does not guess is published as not known", "[sim][uncertainty]") {
  RobotModel model = shipped("pioneer_2dx");
  model.lasers.at(0).errors = {};
  model.odometer->errors = {};
  SimSensors sensors(model, Realism::nominal);
  sensors.publish(scan_of({1.0}));
  sensors.publish(rolled_to(1.0));
  CHECK(latest<idl::LaserRangeReadings>(sensors)->ranges_uncertainty().empty());
  CHECK(latest<idl::Odometry>(sensors)->covariance() == std::array<double, 9>{});
}

TEST_CASE("odometry becomes less certain also while nobody listens", "[sim][uncertainty]") {
  const RobotModel model = shipped("pioneer_2dx");
  SimSensors heard(model, Realism::nominal);
  SimSensors unheard(model, Realism::nominal);
  heard.publish(rolled_to(1.0));
  unheard.skip(rolled_to(1.0));
  heard.publish(rolled_to(2.0));
  unheard.publish(rolled_to(2.0));
  const auto covariance = latest<idl::Odometry>(heard)->covariance();
  CHECK(covariance[0] > 0.0);
  CHECK(latest<idl::Odometry>(unheard)->covariance() == covariance);
}
