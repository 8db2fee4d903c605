// SPDX-License-Identifier: GPL-3.0-or-later
// The poses and stamps of range readings, for sensors on a body that stays behind when the base's wheels steer.
#include <catch2/catch.hpp>

#include <cmath>

#include "objects.hpp"

using namespace orca;
using namespace orca::sim;

namespace {

constexpr Pose2 kBody{0.0, 0.0, -0.5};  // In the robot frame.
constexpr Pose2 kMount{0.1, 0.2, 0.25};
constexpr TimePoint kStamp{std::chrono::milliseconds{1250}};

template <class Sensor>
Sensor mounted() {
  Sensor sensor;
  sensor.center = kMount;
  sensor.height = 0.3;
  sensor.count = 3;
  return sensor;
}

void check_pose(const idl::RangeReadings& readings) {
  const Pose2 expected = kBody * kMount;
  CHECK(readings.pose().position().x() == expected.x);
  CHECK(readings.pose().position().y() == expected.y);
  CHECK(readings.pose().position().z() == 0.3);
  CHECK(readings.pose().rotation().yaw() == expected.yaw);
  CHECK(readings.pose().rotation().roll() == 0.0);
  CHECK(readings.pose().stamp().ns() == 1'250'000'000);
  CHECK(readings.pose().covariance() == std::array<double, 36>());  // Not known.
}

// Returns when tools and queries take the object to have been sensed.
template <class T>
TimePoint sensed_at(const T& object) {
  return object_type<T>().stamp(&object);
}

}  // namespace

TEST_CASE("a round of a sonar ring says where the ring's middle was at the first shot", "[sim][readings]") {
  SonarScan round{.readings = std::vector<SonarReading>(3), .stamp = kStamp, .X_RB = kBody};
  round.readings[1].stamp = kStamp;
  idl::SonarRangeReadings readings;
  fill(readings, round, mounted<SonarRing>());
  check_pose(readings);
  CHECK(sensed_at(readings) == kStamp);
}

TEST_CASE("a round of an infrared ring says where the ring's middle was", "[sim][readings]") {
  idl::InfraredRangeReadings readings;
  fill(readings, InfraredScan{kStamp, {0.1, 0.2, 0.3}, kBody}, mounted<InfraredRing>());
  check_pose(readings);
  CHECK(sensed_at(readings) == kStamp);
}

TEST_CASE("readings in directions that a laser ignores are left out, and the others stay",
          "[sim][readings]") {
  LaserScanner laser = mounted<LaserScanner>();
  laser.first_angle = -0.1;
  laser.pitch = 0.1;
  laser.ignore = {{-0.02, 0.02}};
  idl::LaserRangeReadings readings;
  fill(readings, LaserScan{kStamp, {1.0, 2.0, 3.0}, kBody}, laser);
  CHECK(readings.ranges()[0] == 1.0);
  CHECK(std::isnan(readings.ranges()[1]));
  CHECK(readings.ranges()[2] == 3.0);
}

TEST_CASE("a scan of a laser says where the scanner was at the first reading", "[sim][readings]") {
  idl::LaserRangeReadings readings;
  fill(readings, LaserScan{kStamp, {0.1, 0.2, 0.3}, kBody}, mounted<LaserScanner>());
  check_pose(readings);
  CHECK(readings.stamp() == readings.pose().stamp());
  CHECK(sensed_at(readings) == kStamp);
}

TEST_CASE("readings of sensors without a robot are in the world frame", "[sim][readings]") {
  constexpr Pose2 kPlace{3.0, 4.0, 1.5};
  SharedWorld::Inbox inbox;
  inbox.laser.push_back({0, LaserScan{.stamp = kStamp, .ranges = {1.0, 1.0, 1.0}, .X_RB = {}}});
  SonarReading reading;
  reading.sensor = kMount;
  inbox.sonar.push_back({0, SonarScan{.readings = {reading}, .stamp = kStamp}});
  const SharedWorld::Inbox seen = in_world(inbox, kPlace);
  idl::LaserRangeReadings scan;
  fill(scan, seen.laser.at(0).second, mounted<LaserScanner>());
  const Pose2 expected = kPlace * kMount;
  CHECK(scan.pose().position().x() == expected.x);
  CHECK(scan.pose().position().y() == expected.y);
  CHECK(scan.pose().rotation().yaw() == expected.yaw);
  CHECK(seen.sonar.at(0).second.readings.at(0).sensor == expected);
}
