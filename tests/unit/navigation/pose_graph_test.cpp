// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/pose_graph.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "orca/base/random.hpp"
#include "walls.hpp"

using namespace orca;
using namespace orca::nav;
using orca::test::apart;

namespace {

constexpr PoseInformation kUsual{100.0, 0.0, 100.0, 0.0, 0.0, 400.0};

// Poses on a circle of 20 m, and the exact relations of each to the next, and of the last to the first.
PoseGraph circle(std::size_t count) {
  PoseGraph graph;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const Vec2 place = 20.0 * direction(angle);
    graph.poses.push_back({place.x - 20.0, place.y, wrapped(angle + std::numbers::pi / 2.0)});
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    graph.relations.push_back({i, next, seen_from(graph.poses[i], graph.poses[next]), kUsual});
  }
  return graph;
}

double farthest(std::span<const Pose2> a, std::span<const Pose2> b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max({most, apart(a[i], b[i]).way, apart(a[i], b[i]).turn});
  return most;
}

}  // namespace

TEST_CASE("poses are found from exact relations, wherever they begin", "[navigation]") {
  const PoseGraph right = circle(60);
  PoseGraph graph = right;
  for (std::size_t i = 1; i < graph.poses.size(); ++i) graph.poses[i] = {};
  REQUIRE(begin_anew(graph));
  const PoseGraphFit result = fit(graph);
  CHECK(result.solved);
  CHECK(result.misfit < 1e-12);
  CHECK(farthest(graph.poses, right.poses) < 1e-6);
}

TEST_CASE("an error in a loop is shared by all of its relations", "[navigation]") {
  PoseGraph graph;
  for (int i = 0; i < 10; ++i) graph.poses.push_back({static_cast<double>(i), 0.0, 0.0});
  for (std::size_t i = 0; i + 1 < 10; ++i) graph.relations.push_back({i, i + 1, {1.0, 0.0, 0.0}, kUsual});
  graph.relations.push_back({0, 9, {8.0, 0.0, 0.0}, kUsual});  // a metre less than the nine say
  REQUIRE(fit(graph).solved);
  for (std::size_t i = 0; i < 10; ++i) CHECK(graph.poses[i].x == Approx(0.9 * static_cast<double>(i)));
  // Ten relations are 0.1 m off each, and 100 / m2 is their information.
  CHECK(fit(graph).misfit == Approx(10 * 100.0 * 0.1 * 0.1));
}

TEST_CASE("no small change of the poses fits better than the result", "[navigation]") {
  PoseGraph graph = circle(20);
  RandomStream random(3, "test", "relations");
  for (PoseRelation& relation : graph.relations)
    relation.measured =
        relation.measured *
        Pose2{0.05 * random.normal(0.0, 1.0), 0.05 * random.normal(0.0, 1.0), 0.02 * random.normal(0.0, 1.0)};
  graph.relations.push_back(
      {3, 15, seen_from(graph.poses[3], graph.poses[15]), {90.0, 20.0, 50.0, 5.0, -8.0, 300.0}});
  const PoseGraphFit result = fit(graph);
  REQUIRE(result.solved);
  const auto sum = [&](const std::vector<Pose2>& poses) {
    double all = 0.0;
    for (const PoseRelation& relation : graph.relations) all += misfit(relation, poses);
    return all;
  };
  CHECK(result.misfit == Approx(sum(graph.poses)));
  for (int i = 0; i < 200; ++i) {
    std::vector<Pose2> others = graph.poses;
    for (std::size_t k = 1; k < others.size(); ++k)
      others[k] = others[k] * Pose2{1e-3 * random.normal(0.0, 1.0), 1e-3 * random.normal(0.0, 1.0),
                                    1e-3 * random.normal(0.0, 1.0)};
    CHECK(sum(others) > result.misfit);
  }
}

TEST_CASE("a doubtful relation that is altogether wrong bends nothing", "[navigation]") {
  const PoseGraph right = circle(40);
  PoseGraph graph = right;
  graph.relations.push_back({5, 25, {0.5, 0.0, 0.0}, kUsual, true});
  REQUIRE(fit(graph).solved);
  CHECK(farthest(graph.poses, right.poses) < 0.05);
  graph = right;
  graph.relations.push_back({5, 25, {0.5, 0.0, 0.0}, kUsual, false});
  REQUIRE(fit(graph).solved);
  CHECK(farthest(graph.poses, right.poses) > 5.0);
}

TEST_CASE("a doubtful relation that is right closes a loop", "[navigation]") {
  const PoseGraph right = circle(40);
  PoseGraph graph = right;
  graph.relations.back().doubtful = true;
  graph.relations.back().information = {1e4, 0.0, 1e4, 0.0, 0.0, 4e4};
  for (std::size_t i = 0; i + 1 < graph.relations.size(); ++i) graph.relations[i].measured.yaw += 1e-4;
  for (std::size_t i = 1; i < graph.poses.size(); ++i)
    graph.poses[i] = graph.poses[i - 1] * graph.relations[i - 1].measured;
  REQUIRE(fit(graph).solved);
  CHECK(farthest(graph.poses, right.poses) < 0.02);
}

TEST_CASE("poses that nothing ties to the first stay as they were", "[navigation]") {
  PoseGraph graph = circle(4);
  graph.poses.push_back({7.0, 8.0, 1.0});
  graph.poses[2].x = 3.0;
  const std::vector<Pose2> before = graph.poses;
  CHECK_FALSE(begin_anew(graph));
  CHECK_FALSE(fit(graph).solved);
  CHECK(graph.poses == before);
}

TEST_CASE("a covariance is the inverse of the information, turned into the outer frame", "[navigation]") {
  // 0.1 m along the own x axis, 0.5 m across it, 0.2 rad; the frame is turned to the left, so the outer y axis lies along its x axis.
  const auto c = covariance_of({100.0, 0.0, 4.0, 0.0, 0.0, 25.0}, std::numbers::pi / 2.0);
  CHECK(c[0] == Approx(0.25));
  CHECK(c[4] == Approx(0.01));
  CHECK(c[8] == Approx(0.04));
  CHECK(c[1] == Approx(0.0).margin(1e-12));
  CHECK(c[1] == c[3]);
}

TEST_CASE("after a step a pose is known as well as pose and step together", "[navigation]") {
  // 0.1 m and 0.1 rad before, 0.2 m and 0.05 rad for a step of 10 m ahead: the direction moves the place aside by 1 m.
  const auto c = covariance_of(after({100.0, 0.0, 100.0, 0.0, 0.0, 100.0},
                                     {10.0, 0.0, std::numbers::pi / 2.0}, {25.0, 0.0, 25.0, 0.0, 0.0, 400.0}),
                               std::numbers::pi / 2.0);
  CHECK(c[0] == Approx(0.01 + 0.04));
  CHECK(c[4] == Approx(0.01 + 0.04 + 1.0));
  CHECK(c[8] == Approx(0.01 + 0.0025));
}

TEST_CASE("a relation that is no number leaves all poses as they were", "[navigation]") {
  PoseGraph graph = circle(5);
  graph.relations[2].measured.x = std::nan("");
  const std::vector<Pose2> before = graph.poses;
  CHECK_FALSE(fit(graph).solved);
  CHECK(graph.poses == before);
}
