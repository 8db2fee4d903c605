// SPDX-License-Identifier: GPL-3.0-or-later
// Worlds that are filled unevenly: far posts, long fences, crowds in halls. Rays and views meet what they meet without any
// search, and what stands far away does not make the search near by longer.
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "rays/grid.hpp"
#include "rays/intersect.hpp"
#include "rays/panorama.hpp"

using namespace orca::sim;
using detail::CellLists;
using detail::Elements;
using detail::Grid;
using orca::direction;
using orca::RandomStream;
using orca::Vec2;
using orca::sim::test::kPi;

namespace {

constexpr detail::Heights kTall{0.0, 2.0};
constexpr double kRoom = 20.0;  // [m]
constexpr double kEyes = 0.3;   // [m]

void add_room(Elements& elements, RandomStream& random, Vec2 corner, int things) {
  const Vec2 middle = corner + Vec2{0.5 * kRoom, 0.5 * kRoom};
  elements.add(Box{{middle.x, middle.y, 0.0}, {0.5 * kRoom, 0.5 * kRoom}}, kTall);
  for (int i = 0; i < things; ++i) {
    const Vec2 at = corner + Vec2{random.uniform(1, kRoom - 1), random.uniform(1, kRoom - 1)};
    if (i % 3 == 0) elements.add(Circle{at, random.uniform(0.02, 0.3)}, kTall);
    if (i % 3 != 0)
      elements.add(Box{{at.x, at.y, random.uniform(-kPi, kPi)}, {random.uniform(0.05, 0.4), 0.1}}, kTall);
  }
}

Elements room(int things = 300) {
  RandomStream random(31, "test", "room");
  Elements elements;
  add_room(elements, random, {0, 0}, things);
  return elements;
}

// Rooms of different sizes up to kilometres apart, joined by fences, with posts far outside.
Elements scattered(RandomStream& random) {
  Elements elements;
  Vec2 last;
  for (const double distance : {0.0, 30.0, 700.0, 5000.0}) {
    const Vec2 corner = distance * direction(random.uniform(-kPi, kPi));
    add_room(elements, random, corner, 60);
    elements.edges.push_back({{last, corner}, kTall});
    last = corner;
  }
  for (int i = 0; i < 10; ++i)
    elements.add(Circle{random.uniform(0.0, 60'000.0) * direction(random.uniform(-kPi, kPi)), 0.1}, kTall);
  elements.add(Circle{{100.0, 100.0}, 400.0}, kTall);
  return elements;
}

// Returns a ray or the axis of a cone from beside some element, at times straight to another one.
Ray ray_among(const Elements& elements, RandomStream& random) {
  const auto corner = [&] {
    return elements
        .edges[static_cast<std::size_t>(
            random.uniform(0.0, static_cast<double>(elements.edges.size()) - 1e-6))]
        .segment.a;
  };
  const Vec2 from = corner() + random.uniform(0.0, 8.0) * direction(random.uniform(-kPi, kPi));
  const Vec2 to = corner();
  const bool aims = random.chance(0.3) && norm(to - from) > 0.0;
  return {from, aims ? (1.0 / norm(to - from)) * (to - from) : direction(random.uniform(-kPi, kPi)),
          random.chance(0.3) ? 50'000.0 : random.uniform(1.0, 40.0), kEyes};
}

double nearest_without_search(const Elements& elements, const Ray& ray) {
  double best = ray.max_range;
  for (const auto& e : elements.edges) detail::meet(ray.origin, ray.direction, e.segment, best);
  for (const auto& r : elements.rounds) detail::meet(ray.origin, ray.direction, r.circle, best);
  return best;
}

detail::Panorama seen_without_search(const Elements& elements, const detail::Cone& cone) {
  detail::Panorama view;
  view.begin(cone, kEyes);
  for (const auto& e : elements.edges) view.add(e.segment, 1, e.heights.bottom, e.heights.top);
  for (const auto& r : elements.rounds) view.add(r.circle, 1, r.heights.bottom, r.heights.top);
  view.finish();
  return view;
}

// Returns how far a view reaches in a direction; the cone's reach if nothing is there.
double depth(const detail::Panorama& view, const detail::Cone& cone, double bearing) {
  const auto& patch = view.first_patch_at(bearing);
  if (patch.what == detail::Panorama::kNothing) return cone.reach;
  return std::min(cone.reach, norm(view.boundary(patch).at(bearing)));
}

// Returns how many elements rays of 8 m from places in the room are compared with, on average.
double looks_per_ray(const Elements& elements) {
  const Grid grid(elements);
  RandomStream random(33, "test", "looks");
  constexpr int kRays = 2000;
  double looks = 0.0;
  for (int i = 0; i < kRays; ++i) {
    const Ray ray{{random.uniform(1, kRoom - 1), random.uniform(1, kRoom - 1)},
                  direction(random.uniform(-kPi, kPi)),
                  8.0,
                  kEyes};
    const double best = nearest_without_search(elements, ray);
    grid.regions().cross(ray, best, [&](const CellLists& lists) {
      lists.cells().walk(ray, 0.0, best, [&](std::size_t cell) {
        looks += 1.0 + static_cast<double>(lists.at(cell).size());
      });
    });
  }
  return looks / kRays;
}

// Returns the cells of all regions.
std::vector<detail::Cells> cells_of(const Grid& grid) {
  std::vector<detail::Cells> cells;
  grid.regions().survey(detail::Cone({0, 0}, {1, 0}, 0.5 * kPi, 1e6, 1e6),
                        [&](const CellLists& lists) { cells.push_back(lists.cells()); });
  REQUIRE(cells.size() == grid.regions().count());
  return cells;
}

}  // namespace

TEST_CASE("rays in a world that is filled unevenly are, bit for bit, those of no search at all",
          "[sim][caster]") {
  RandomStream random(32, "test", "scattered");
  int met = 0;
  for (int world = 0; world < 10; ++world) {
    const Elements elements = scattered(random);
    const Grid grid(elements);
    REQUIRE(grid.regions().count() > 4);
    for (int i = 0; i < 2000; ++i) {
      const Ray ray = ray_among(elements, random);
      Hit hit;
      hit.range = ray.max_range;
      grid.cast(ray, hit);
      CAPTURE(world, i, ray.origin.x, ray.origin.y, ray.direction.x, ray.direction.y);
      REQUIRE(hit.range == nearest_without_search(elements, ray));
      met += hit.found() ? 1 : 0;
    }
  }
  CHECK(met > 10'000);
}

TEST_CASE("no ray of a cone meets anything within its empty depth in a world that is filled unevenly",
          "[sim][caster]") {
  RandomStream random(34, "test", "scattered");
  int worth = 0;
  for (int world = 0; world < 4; ++world) {
    const Elements elements = scattered(random);
    const Grid grid(elements);
    for (int i = 0; i < 500; ++i) {
      Ray ray = ray_among(elements, random);
      ray.max_range = std::min(ray.max_range, 40.0);
      const double half = random.uniform(0.0, 0.3);
      const double empty = grid.empty_depth({ray.origin, ray.direction, half, 0.0, ray.max_range});
      ray.direction = rotated(ray.direction, random.uniform(-half, half));
      const double nearest = nearest_without_search(elements, ray);
      CAPTURE(world, i, half);
      REQUIRE(empty <= nearest);
      if (empty > 0.3 * nearest) ++worth;
    }
  }
  CHECK(worth > 200);
}

TEST_CASE("views in a world that is filled unevenly show what they show without a search", "[sim][caster]") {
  RandomStream random(35, "test", "scattered");
  int seen = 0;
  for (int world = 0; world < 4; ++world) {
    const Elements elements = scattered(random);
    const Grid grid(elements);
    for (int i = 0; i < 300; ++i) {
      const Ray axis = ray_among(elements, random);
      const detail::Cone cone(axis.origin, axis.direction, random.uniform(0.05, 0.5 * kPi), 0.0,
                              axis.max_range);
      detail::Panorama view;
      view.begin(cone, kEyes);
      grid.show(cone, 1, 1, view);
      view.finish();
      const detail::Panorama all = seen_without_search(elements, cone);
      const double rim = detail::bearing_of({dot(cone.axis, cone.left), cross(cone.axis, cone.left)});
      for (int k = 0; k < 20; ++k) {
        const double bearing = random.uniform(-rim, rim);
        CAPTURE(world, i, k, bearing);
        REQUIRE(depth(view, cone, bearing) == Approx(depth(all, cone, bearing)).margin(1e-6));
        seen += depth(all, cone, bearing) < cone.reach ? 1 : 0;
      }
    }
  }
  CHECK(seen > 10'000);
}

TEST_CASE("a far post leaves the cells of a room as they are", "[sim][caster]") {
  const double distance = GENERATE(60.0, 2000.0, 90'000.0);
  const double angle = GENERATE(range(0, 8)) * 0.25 * kPi + 0.01;
  Elements elements = room();
  const std::vector<detail::Cells> alone = cells_of(Grid(elements));
  REQUIRE(alone.size() == 1);
  elements.add(Circle{Vec2{0.5 * kRoom, 0.5 * kRoom} + distance * direction(angle), 0.1}, kTall);
  const std::vector<detail::Cells> with_post = cells_of(Grid(elements));
  REQUIRE(with_post.size() == 2);
  CHECK(std::ranges::count_if(with_post, [&](const detail::Cells& cells) {
          return cells.size() == alone[0].size() && cells.columns() == alone[0].columns() &&
                 cells.rows() == alone[0].rows() && cells.low(0, 0) == alone[0].low(0, 0);
        }) == 1);
}

TEST_CASE(
    "rays in a room are compared with as few elements if a fence of 2 km leads to it, or a hall surrounds it",
    "[sim][caster]") {
  const double alone = looks_per_ray(room());
  Elements fenced = room();
  fenced.edges.push_back({{{-2000.0, 3.0}, {0.0, 3.0}}, kTall});
  fenced.edges.push_back({{{0.0, 5.0}, {-2000.0, 600.0}}, kTall});
  Elements in_hall = room();
  in_hall.add(Box{{100.0, -50.0, 0.0}, {1000.0, 1000.0}}, kTall);
  CAPTURE(alone, looks_per_ray(fenced), looks_per_ray(in_hall));
  CHECK(looks_per_ray(fenced) < 1.25 * alone);
  CHECK(looks_per_ray(in_hall) < 1.25 * alone);
}

TEST_CASE("the memory for a world depends on what stands in it, and not on its extent", "[sim][caster]") {
  RandomStream random(36, "test", "scattered");
  for (int world = 0; world < 10; ++world) {
    const Elements elements = scattered(random);
    std::size_t cells = 0;
    for (const detail::Cells& region : cells_of(Grid(elements))) cells += region.count();
    // Two per element, each of which may be cut once, and a row and a column more per region.
    CHECK(cells < 10 * elements.count());
  }
}
