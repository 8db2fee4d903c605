// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/pose_history.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using orca::from_seconds;
using orca::TimePoint;
using orca::nav::PoseHistory;

namespace {

TimePoint at(double seconds) { return TimePoint{from_seconds(seconds)}; }

}  // namespace

TEST_CASE("a pose between two others lies on the straight line, and turns the shorter way", "[navigation]") {
  PoseHistory history;
  history.add(at(1.0), {0.0, 0.0, 3.0});
  history.add(at(1.1), {1.0, 2.0, -3.0});
  const auto pose = history.at(at(1.05));
  REQUIRE(pose);
  CHECK(std::abs(pose->x - 0.5) < 1e-9);
  CHECK(std::abs(pose->y - 1.0) < 1e-9);
  CHECK(std::abs(std::abs(pose->yaw) - std::numbers::pi) < 1e-9);
}

TEST_CASE("nothing is known of instants before the first pose and after the last", "[navigation]") {
  PoseHistory history;
  CHECK_FALSE(history.at(at(1.0)));
  history.add(at(1.0), {1.0, 0.0, 0.0});
  history.add(at(2.0), {2.0, 0.0, 0.0});
  CHECK_FALSE(history.at(at(0.9)));
  CHECK_FALSE(history.at(at(2.1)));
  CHECK(history.at(at(2.0)) == orca::Pose2{2.0, 0.0, 0.0});
  CHECK(history.at(at(1.0)) == orca::Pose2{1.0, 0.0, 0.0});
}

TEST_CASE("time that runs backwards makes the history begin anew", "[navigation]") {
  PoseHistory history;
  history.add(at(5.0), {});
  history.add(at(1.0), {1.0, 0.0, 0.0});
  CHECK_FALSE(history.at(at(5.0)));
  CHECK(history.at(at(1.0)));
}
