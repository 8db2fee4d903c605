// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using namespace orca::sim::test;

namespace {

// As on a Pioneer: eight transducers in front and eight behind, one of each fires every 40 ms.
SonarRing front_and_rear() {
  SonarRing ring = scout().sonars[0];
  ring.period = std::chrono::milliseconds{320};
  ring.order = {0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15};
  ring.parallel = 2;
  return ring;
}

std::vector<double> stamps(const SonarRing& ring) {
  RobotModel model = scout();
  model.sonars = {ring};
  World world({}, {});
  const RobotId id = *world.add_robot("pioneer", model, {});
  while (!world.sonar(id)) world.step();
  CHECK(world.time() == orca::TimePoint{} + ring.period);
  std::vector<double> list;
  for (const SonarReading& reading : world.sonar(id)->readings)
    list.push_back(orca::to_seconds(reading.stamp - orca::TimePoint{}));
  return list;
}

}  // namespace

TEST_CASE("front and rear transducers fire in parallel, 40 ms after the ones before", "[sim][sonar]") {
  const std::vector<double> fired = stamps(front_and_rear());
  REQUIRE(fired.size() == 16);
  for (std::size_t k = 0; k < 8; ++k) {
    CHECK(fired[k] == Approx(0.04 * static_cast<double>(k + 1)));
    CHECK(fired[k + 8] == fired[k]);
  }
}

TEST_CASE("a last group that is not full fires at the end of the round", "[sim][sonar]") {
  SonarRing ring = front_and_rear();
  ring.count = 3;
  ring.order = {2, 0, 1};
  ring.period = std::chrono::milliseconds{100};
  CHECK(stamps(ring) == std::vector<double>{0.05, 0.1, 0.05});
}
