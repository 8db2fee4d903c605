// SPDX-License-Identifier: GPL-3.0-or-later
#include "world/robot.hpp"

#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::Pose2;
using orca::TimePoint;
using orca::sim::detail::Trail;

namespace {

// Returns where a robot is after so many centimetres of a way that winds along the x axis.
RobotSnapshot::Sample sample_at(int centimetres) {
  const double s = 0.01 * centimetres;
  return {TimePoint(std::chrono::milliseconds(20 * centimetres)), {s, 0.3 * std::sin(0.5 * s), 0.1}};
}

Trail trail_of(int centimetres) {
  Trail trail(sample_at(0));
  for (int k = 1; k <= centimetres; ++k) trail.add(sample_at(k));
  return trail;
}

}  // namespace

TEST_CASE("a short way is kept with a pose per 5 cm, and a turn on the spot with one per 0.2 rad",
          "[sim][picture]") {
  CHECK(trail_of(1000).samples().size() == Approx(201).margin(8));
  Trail turning(RobotSnapshot::Sample{});
  for (int k = 1; k <= 150; ++k) turning.add({TimePoint{}, {0.0, 0.0, 0.02 * k}});
  CHECK(turning.samples().size() == Approx(16).margin(1));
}

// 30 km: about a day of a robot that never rests.
TEST_CASE(
    "the way of a long run takes no more memory than its bound, and is kept from its begin to its end, "
    "evenly",
    "[sim][picture]") {
  const int centimetres = GENERATE(80'000, 90'000, 500'000, 3'000'000);
  const Trail trail = trail_of(centimetres);
  const auto& samples = trail.samples();
  CHECK(samples.size() <= Trail::kMost);
  CHECK(samples.size() >= Trail::kMost / 2);
  CHECK(samples.capacity() <= 2 * Trail::kMost);
  CHECK(samples.front().pose == sample_at(0).pose);
  const double mean = 0.01 * centimetres / static_cast<double>(samples.size() - 1);
  for (std::size_t k = 1; k < samples.size(); ++k)
    REQUIRE(norm(samples[k].pose.position() - samples[k - 1].pose.position()) < 2.0 * mean + 0.05);
  CHECK(norm(samples.back().pose.position() - sample_at(centimetres).pose.position()) < 2.0 * mean + 0.05);
}

TEST_CASE("a world keeps the way of a robot only if it is asked to", "[sim][picture]") {
  World world({"empty", {}, {}}, {.seed = 1, .realism = Realism::ideal});
  const RobotId drawn = *world.add_robot("drawn", sim::test::scout(), {});
  const RobotId other = *world.add_robot("other", sim::test::scout(), {0.0, 3.0, 0.0});
  world.keep_trajectory(drawn);
  for (const RobotId robot : {drawn, other}) REQUIRE(world.set_velocity_command(robot, 0.5, 0.1));
  for (int tick = 0; tick < 1000; ++tick) world.step();
  const Snapshot snapshot = world.snapshot();
  REQUIRE(snapshot.robots.size() == 2);
  const auto& kept = snapshot.robots[0].trajectory;
  CHECK(kept.size() > 80);  // 4.8 m.
  CHECK(kept.front().pose == Pose2{});
  CHECK(kept.back().pose == world.pose(drawn));
  CHECK(snapshot.robots[1].trajectory.empty());
  CHECK(snapshot.robots[1].pose == world.pose(other));
}
