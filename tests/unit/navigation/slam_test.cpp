// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/slam.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>

#include "walls.hpp"

using namespace orca;
using namespace orca::nav;
using test::apart;

namespace {

// A corridor 2 m wide around a block of 12 x 8 m, with niches that tell its sides apart.
test::Walls ring() {
  test::Walls walls = test::box({-8.0, -6.0}, {8.0, 6.0});
  for (const auto& more : {test::box({-6.0, -4.0}, {6.0, 4.0}), test::box({-2.0, 5.6}, {-1.2, 6.0}),
                           test::box({3.0, 5.7}, {3.4, 6.0}), test::box({7.5, 1.0}, {8.0, 1.6}),
                           test::box({-8.0, -1.0}, {-7.4, -0.4}), test::box({0.5, -6.0}, {1.7, -5.5}),
                           test::box({-4.5, -6.0}, {-4.2, -5.6}), test::box({-6.4, 2.0}, {-6.0, 2.5}),
                           test::box({2.0, 4.0}, {2.3, 4.4})})
    walls.insert(walls.end(), more.begin(), more.end());
  return walls;
}

// Places every 0.25 m on a way round the block.
std::vector<Pose2> rounds(int count) {
  const std::vector<Vec2> corners{{7.0, -5.0}, {7.0, 5.0}, {-7.0, 5.0}, {-7.0, -5.0}};
  std::vector<Pose2> way;
  Vec2 here{0.0, -5.0};
  const auto drive_to = [&](Vec2 goal, double yaw) {
    const int steps = static_cast<int>(norm(goal - here) / 0.25);
    for (int i = 0; i < steps; ++i)
      way.push_back({here.x + (goal - here).x * i / steps, here.y + (goal - here).y * i / steps, yaw});
    here = goal;
  };
  double yaw = 0.0;
  for (int round = 0; round < count; ++round) {
    for (const Vec2 corner : corners) {
      drive_to(corner, yaw);
      for (int i = 1; i < 6; ++i)
        way.push_back({corner.x, corner.y, wrapped(yaw + i * std::numbers::pi / 12.0)});
      yaw = wrapped(yaw + std::numbers::pi / 2.0);
    }
    drive_to({0.0, -5.0}, yaw);
  }
  return way;
}

struct Mapped {
  std::vector<Pose2> estimates;
  double worst = 0.0;  // [m] of the nodes at the end, relative to the first
  double worst_by_odometry = 0.0;
  std::size_t loops = 0;
};

// Odometry that drifts: 3 % of the way too long, 0.02 rad per m to the left, and noise.
Mapped map_on(std::span<const Pose2> way, const test::Walls& walls) {
  RandomStream random(8, "test", "drive");
  Slam slam;
  Mapped result;
  Pose2 X_OR;
  std::vector<Pose2> right{};
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Pose2 moved = i > 0 ? seen_from(way[i - 1], way[i]) : Pose2();
    const double length = norm(moved.position());
    X_OR = X_OR * Pose2{1.03 * moved.x + random.normal(0.0, 0.005), moved.y + random.normal(0.0, 0.005),
                        moved.yaw + 0.02 * length + random.normal(0.0, 0.005)};
    const std::size_t before = slam.nodes().size();
    result.estimates.push_back(slam.see(test::scan_of(walls, way[i], 0.01, random), X_OR));
    if (slam.nodes().size() > before) right.push_back(way[i]);
  }
  slam.finish();
  for (std::size_t i = 0; i < right.size(); ++i) {
    const Pose2 truth = seen_from(right[0], right[i]);
    result.worst =
        std::max(result.worst, apart(seen_from(slam.nodes()[0].X_MR, slam.nodes()[i].X_MR), truth).way);
    result.worst_by_odometry = std::max(
        result.worst_by_odometry, apart(seen_from(slam.nodes()[0].X_OR, slam.nodes()[i].X_OR), truth).way);
  }
  result.loops = slam.loops();
  return result;
}

}  // namespace

TEST_CASE("a robot that drives round a block twice knows where it was", "[navigation]") {
  const Mapped result = map_on(rounds(2), ring());
  std::cout << "worst " << result.worst << " m, by odometry " << result.worst_by_odometry << " m, "
            << result.loops << " loops\n";
  CHECK(result.worst_by_odometry > 3.0);
  CHECK(result.loops > 20);
  CHECK(result.worst < 0.1);
}

TEST_CASE("the same scans give the same bits", "[navigation]") {
  CHECK(map_on(rounds(1), ring()).estimates == map_on(rounds(1), ring()).estimates);
}

TEST_CASE(
    "a map goes on where another day ended: half of the way each, from another place, by another odometry",
    "[navigation]") {
  const test::Walls walls = ring();
  const std::vector<Pose2> way = rounds(1);
  RandomStream random(10, "test", "days");
  const auto drive = [&](Slam& slam, std::size_t first, std::size_t last, const Pose2& X_OM) {
    for (std::size_t i = first; i < last; ++i)
      (void)slam.see(test::scan_of(walls, way[i], 0.01, random), X_OM * way[i]);
  };
  Slam monday;
  drive(monday, 0, way.size() / 2, {});
  const std::size_t before = monday.nodes().size();
  const std::size_t loops = monday.loops();
  REQUIRE(check(monday.memory()).ok());

  Slam tuesday(monday.memory());
  CHECK(tuesday.nodes().size() == before);
  const Pose2 X_OM{40.0, -3.0, 2.0};
  const std::size_t start = way.size() / 8;  // Somebody has carried it back to a place that the map knows.
  tuesday.enter(test::scan_of(walls, way[start], 0.01, random), X_OM * way[start], way[start]);
  CHECK(tuesday.nodes().size() == before + 1);
  drive(tuesday, start + 1, way.size(), X_OM);
  CHECK(tuesday.loops() > loops);
  CHECK(tuesday.nodes().size() > before + before / 2);
  // Both days' scans lie where they were taken.
  double worst = 0.0;
  for (const SlamNode& node : tuesday.nodes()) {
    double nearest = 1e9;
    for (const Pose2& place : way) nearest = std::min(nearest, apart(place, node.X_MR).way);
    worst = std::max(worst, nearest);
  }
  CHECK(worst < 0.1);
}

TEST_CASE("what says nothing valid of a map is refused", "[navigation]") {
  Slam slam;
  for (int i = 0; i <= 20; ++i) (void)slam.see({}, {0.25 * i, 0.0, 0.0});
  const SlamMemory good = slam.memory();
  REQUIRE(check(good).ok());
  CHECK(check({}).ok());
  const auto refuses = [&](const auto& spoil) {
    SlamMemory bad = good;
    spoil(bad);
    return !check(bad).ok();
  };
  const double kNone = std::nan("");
  CHECK(refuses([&](SlamMemory& bad) { bad.nodes[3].X_MR.x = kNone; }));
  CHECK(refuses([&](SlamMemory& bad) { bad.nodes[3].X_MR.x = 2000.0; }));
  CHECK(refuses([&](SlamMemory& bad) { bad.nodes[3].scan.push_back({{kNone, 0.0}, {}}); }));
  CHECK(refuses([&](SlamMemory& bad) { bad.nodes[3].scan.push_back({{1e9, 0.0}, {}}); }));
  CHECK(refuses([&](SlamMemory& bad) { bad.nodes.pop_back(); }));
  CHECK(refuses([&](SlamMemory& bad) { bad.relations[0].to = 21; }));
  CHECK(refuses([&](SlamMemory& bad) { bad.relations[0].information.tt = kNone; }));
  CHECK(refuses([&](SlamMemory& bad) { bad.submaps[0].count = 22; }));
  CHECK(refuses([&](SlamMemory& bad) { bad.submaps[0].first = 21; }));
  CHECK(refuses([&](SlamMemory& bad) { bad.way = kNone; }));
}

TEST_CASE("where scans show nothing, the pose is odometry's", "[navigation]") {
  Slam slam;
  Pose2 X_MR;
  for (int i = 0; i <= 20; ++i) X_MR = slam.see({}, {0.25 * i, 0.0, 0.0});
  CHECK(X_MR.x == Approx(5.0));
  CHECK(slam.nodes().size() == 21);
  slam.finish();
  CHECK(slam.nodes().back().X_MR.x == Approx(5.0));
}

TEST_CASE("along a corridor without an end the pose is known less and less, but not across", "[navigation]") {
  RandomStream random(9, "test", "corridor");
  const test::Walls corridor{{{-90.0, 1.0}, {90.0, 1.0}}, {{-90.0, -1.0}, {90.0, -1.0}}};
  Slam slam;
  for (int i = 0; i <= 80; ++i) {
    const Pose2 here{0.25 * i - 10.0, 0.0, 0.0};
    (void)slam.see(test::scan_of(corridor, here, 0.01, random), here);
  }
  const Pose2 there{10.0, 0.0, 0.0};
  const auto c = covariance_of(slam.known_at(there), 0.0);
  CHECK(std::sqrt(c[0]) > 3.0 * std::sqrt(c[4]));
  CHECK(std::sqrt(c[4]) < 0.1);
  // Without another scan odometry alone says where it is.
  CHECK(covariance_of(slam.known_at({14.0, 0.0, 0.0}), 0.0)[4] > 0.1);
}
