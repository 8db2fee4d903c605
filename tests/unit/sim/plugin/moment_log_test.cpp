// SPDX-License-Identifier: GPL-3.0-or-later
#include "moment_log.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::sim;

namespace {

SharedWorld::Inbox truth_at(int tenths) {
  SharedWorld::Inbox inbox;
  inbox.truth.push_back({TimePoint(std::chrono::milliseconds(100 * tenths)), {0.1 * tenths, 0.0, 0.0}, {}});
  return inbox;
}

}  // namespace

TEST_CASE("a short run is kept whole", "[sim][picture]") {
  const RobotModel robot;
  MomentLog log(robot);
  for (int i = 0; i < 100; ++i) log.add(truth_at(i));
  const auto moments = log.moments();
  REQUIRE(moments.size() == 100);
  CHECK(moments[40].pose.x == Approx(4.0));
}

TEST_CASE("a bounded number of moments of a long run is kept, in even steps, with the first and the last",
          "[sim][picture]") {
  const RobotModel robot;
  for (const int count : {511, 512, 513, 1023, 1024, 1025, 5000, 36000}) {
    CAPTURE(count);
    MomentLog log(robot);
    for (int i = 0; i < count; ++i) log.add(truth_at(i));
    const auto moments = log.moments();
    CHECK(moments.size() <= 513);
    CHECK(moments.size() >= 250);
    CHECK(moments.front().time == TimePoint{});
    CHECK(moments.back().time == truth_at(count - 1).truth[0].stamp);
    const Duration step = moments[1].time - moments[0].time;
    for (std::size_t i = 2; i + 1 < moments.size(); ++i)
      REQUIRE(moments[i].time - moments[i - 1].time == step);
  }
}

TEST_CASE("the first moment of a long run keeps its readings", "[sim][picture]") {
  RobotModel robot;
  robot.sonars.resize(1);
  MomentLog log(robot);
  SharedWorld::Inbox first = truth_at(0);
  first.sonar.push_back({0, {{{0, TimePoint{}, {0.2, 0.1, 0.5}, 1.5, true}}}});
  log.add(first);
  for (int i = 1; i < 600; ++i) log.add(truth_at(i));
  REQUIRE(log.moments().front().sonar.size() == 1);
  CHECK(log.moments().front().sonar[0].range_m == 1.5);
}

TEST_CASE("a moment shows the latest readings, in the robot's frame", "[sim][picture]") {
  RobotModel robot;
  robot.sonars.resize(1);
  robot.sonars[0].half_lobe = 0.2;
  robot.lasers.resize(1);
  robot.lasers[0].pitch = 1.0;
  robot.lasers[0].center = {0.1, 0.0, 0.0};
  MomentLog log(robot);
  SharedWorld::Inbox inbox = truth_at(1);
  inbox.sonar.push_back({0, {{{0, TimePoint{}, {0.2, 0.1, 0.5}, 1.5, true}}}});
  inbox.laser.push_back({0, {TimePoint{}, {2.0, 3.0}, {}}});
  log.add(inbox);
  log.add(truth_at(2));
  const orca::Scene::Moment last = log.moments().back();
  REQUIRE(last.sonar.size() == 1);
  CHECK(last.sonar[0].X_RS.yaw == 0.5);
  CHECK(last.sonar[0].half_lobe_rad == 0.2);
  CHECK(last.sonar[0].range_m == 1.5);
  REQUIRE(last.lasers.size() == 1);
  REQUIRE(last.lasers[0].ends.size() == 2);
  CHECK(last.lasers[0].ends[0].x == Approx(2.1));
  CHECK(last.lasers[0].ends[1].x == Approx(0.1 + 3.0 * std::cos(1.0)));
}
