// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/surface.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "walls.hpp"

using namespace orca;
using namespace orca::nav;

TEST_CASE("the normals of a wall point to the sensor", "[navigation]") {
  RandomStream random(1, "test", "noise");
  const test::Walls wall{{{3.0, -5.0}, {3.0, 5.0}}};
  for (const double yaw : {-0.8, 0.0, 0.6}) {
    const auto scan = test::scan_of(wall, {0.0, 0.0, yaw}, 0.005, random);
    REQUIRE(scan.size() > 60);
    for (const SurfacePoint& point : scan) {
      if (point.normal == Vec2{})
        continue;  // at the ends of the wall the noise is as wide as what is seen of it
      CHECK(norm(point.normal) == Approx(1.0));
      CHECK(dot(rotated(point.normal, yaw), {-1.0, 0.0}) > 0.95);
    }
  }
}

TEST_CASE("a point between far neighbours, or among scattered ones, has no normal", "[navigation]") {
  const std::vector<Vec2> apart{{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}};
  for (const SurfacePoint& point : surface_of(apart, {})) CHECK(point.normal == Vec2{});
  const std::vector<Vec2> scattered{{1.0, 0.0}, {1.1, 0.1}, {0.9, 0.1}, {1.0, 0.2}, {1.15, -0.05}};
  CHECK(surface_of(scattered, {})[2].normal == Vec2{});
}

TEST_CASE("the nearest point is that which a search through all finds", "[navigation]") {
  RandomStream random(5, "test", "points");
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 400; ++i)
    points.push_back({{random.uniform(-4.0, 4.0), random.uniform(-3.0, 3.0)}, {}});
  SurfaceMap map;
  map.add(std::span(points).first(150), {});
  map.add(std::span(points).last(250), {});
  map.prepare();
  for (int i = 0; i < 2000; ++i) {
    const Vec2 place{random.uniform(-5.0, 5.0), random.uniform(-4.0, 4.0)};
    const double reach = random.uniform(0.01, SurfaceMap::kReach);
    double least = reach;
    for (const SurfacePoint& point : points) least = std::min(least, norm(point.at - place));
    const SurfacePoint* const found = map.nearest(place, reach);
    if (least == reach)
      CHECK(found == nullptr);
    else
      CHECK(norm(found->at - place) == Approx(least));
  }
}

TEST_CASE("a map without points has no nearest one", "[navigation]") {
  SurfaceMap map;
  map.prepare();
  CHECK(map.nearest({0.0, 0.0}, 0.5) == nullptr);
}
