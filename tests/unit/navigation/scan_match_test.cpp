// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/scan_match.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "walls.hpp"

using namespace orca;
using namespace orca::nav;
using test::apart;

namespace {

// A room of 8 x 6 m with a cupboard, a pillar and a door.
test::Walls room() {
  test::Walls walls = test::box({-4.0, -3.0}, {4.0, 3.0});
  walls.erase(walls.begin());
  walls.push_back({{-4.0, -3.0}, {1.0, -3.0}});
  walls.push_back({{2.0, -3.0}, {4.0, -3.0}});
  for (const auto& more : {test::box({2.5, 1.0}, {4.0, 3.0}), test::box({-2.0, -1.0}, {-1.7, -0.7})})
    walls.insert(walls.end(), more.begin(), more.end());
  return walls;
}

SurfaceMap map_of(const test::Walls& walls, std::span<const Pose2> places, RandomStream& random) {
  SurfaceMap map;
  for (const Pose2& place : places) map.add(test::scan_of(walls, place, 0.01, random), place);
  map.prepare();
  return map;
}

const std::vector<Pose2> kPlaces{
    {0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}, {1.5, 0.0, 1.0}, {-2.5, 1.0, -1.0}, {0.5, -2.0, 2.0}};

}  // namespace

TEST_CASE("a scan is moved to where it was taken", "[navigation]") {
  RandomStream random(2, "test", "scans");
  const SurfaceMap map = map_of(room(), kPlaces, random);
  for (int i = 0; i < 100; ++i) {
    const Pose2 right{random.uniform(-1.0, 2.0), random.uniform(-0.5, 1.5), random.uniform(-3.0, 3.0)};
    const Pose2 guess =
        right * Pose2{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
    const auto match = refine(test::scan_of(room(), right, 0.01, random), map, guess);
    CAPTURE(i, right.x, right.y, right.yaw);
    REQUIRE(match);
    CHECK(apart(match->X_MR, right).way < 0.02);
    CHECK(apart(match->X_MR, right).turn < 0.01);
    CHECK(match->share > 0.8);
    CHECK(match->spread < 0.03);
  }
}

TEST_CASE("along a corridor without an end a match knows little of the place", "[navigation]") {
  RandomStream random(2, "test", "scans");
  const test::Walls corridor{{{-50.0, 1.0}, {50.0, 1.0}}, {{-50.0, -1.0}, {50.0, -1.0}}};
  const std::vector<Pose2> places{{0.0, 0.0, 0.0}, {0.0, 0.0, 3.1}, {1.0, 0.2, 0.0}};
  const SurfaceMap map = map_of(corridor, places, random);
  const auto match = refine(test::scan_of(corridor, {0.3, 0.1, 0.05}, 0.01, random), map, {0.35, 0.0, 0.0});
  REQUIRE(match);
  CHECK(std::fabs(match->X_MR.y - 0.1) < 0.02);
  CHECK(std::fabs(match->X_MR.yaw - 0.05) < 0.01);
  // The scan's frame is turned by 0.05, so a quarter of a percent of what is known across shows along.
  CHECK(match->information.xx < 0.02 * match->information.yy);
}

TEST_CASE("a scan that hardly touches the map has no match", "[navigation]") {
  RandomStream random(2, "test", "scans");
  const SurfaceMap map = map_of(room(), kPlaces, random);
  CHECK_FALSE(refine(test::scan_of(room(), {}, 0.01, random), map, {30.0, 0.0, 0.0}));
  CHECK_FALSE(refine({}, map, {}));
}

TEST_CASE("the search finds what a look at all places finds", "[navigation]") {
  RandomStream random(4, "test", "scans");
  const SurfaceMap map = map_of(room(), kPlaces, random);
  const ScanSearch search(map.points());
  for (int i = 0; i < 8; ++i) {
    const Pose2 right{random.uniform(-1.0, 2.0), random.uniform(-0.5, 1.5), random.uniform(-3.0, 3.0)};
    const auto scan = test::scan_of(room(), right, 0.01, random);
    double farthest = 0.0;
    for (const SurfacePoint& point : scan) farthest = std::max(farthest, norm(point.at));
    const SearchWindow window{right * Pose2{0.17, -0.22, 0.05}, 0.4, 0.1};
    const auto found = search.best(scan, window, 0.3);
    REQUIRE(found);
    double best = 0.0;
    const double pitch = ScanSearch::kSide / farthest;
    const int turns = static_cast<int>(std::ceil(window.turn / pitch));
    for (int turn = -turns; turn <= turns; ++turn)
      for (int x = -8; x <= 8; ++x)
        for (int y = -8; y <= 8; ++y)
          best = std::max(best, search.score(scan, {window.middle.x + x * ScanSearch::kSide,
                                                    window.middle.y + y * ScanSearch::kSide,
                                                    window.middle.yaw + turn * pitch}));
    CHECK(found->score == Approx(best).margin(1e-3));
    CHECK(apart(found->X_MR, right).way < 0.08);
  }
}

TEST_CASE("a scan is found anywhere in a room, with no guess of its direction", "[navigation]") {
  RandomStream random(6, "test", "scans");
  const SurfaceMap map = map_of(room(), kPlaces, random);
  const ScanSearch search(map.points());
  for (int i = 0; i < 20; ++i) {
    const Pose2 right{random.uniform(-1.0, 2.0), random.uniform(-0.5, 1.5), random.uniform(-3.0, 3.0)};
    const auto found =
        search.best(test::scan_of(room(), right, 0.01, random), {{}, 5.0, std::numbers::pi}, 0.5);
    CAPTURE(i, right.x, right.y, right.yaw);
    REQUIRE(found);
    CHECK(apart(found->X_MR, right).way < 0.1);
    CHECK(apart(found->X_MR, right).turn < 0.05);
  }
}

TEST_CASE("nothing is found below the least score, or without points", "[navigation]") {
  RandomStream random(6, "test", "scans");
  const SurfaceMap map = map_of(room(), kPlaces, random);
  const ScanSearch search(map.points());
  const auto other = test::scan_of(test::box({-1.0, -0.4}, {1.0, 0.4}), {}, 0.01, random);
  CHECK_FALSE(search.best(other, {{0.0, 1.0, 0.0}, 0.5, 0.5}, 0.9));
  CHECK_FALSE(search.best({}, {{}, 0.5, 0.5}, 0.0));
  CHECK_FALSE(ScanSearch({}).best(other, {{}, 0.5, 0.5}, 0.0));
}
