// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/sim/generate.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>

#include "orca/base/hash.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/world_file.hpp"
#include "plan.hpp"
#include "slow_run.hpp"

using namespace orca::sim;
using orca::direction;
using orca::Vec2;
using orca::sim::test::Plan;

namespace {

const std::vector<Family> kFamilies{BarnField{}, UTrap{}, NarrowDoors{}, Corridor{}, OfficeFloor{}};

WorldModel made(const Family& family, std::uint64_t seed, double radius = 0.3) {
  const auto world = generate(family, seed, radius);
  INFO((world ? std::string() : world.error().message));
  REQUIRE(world);
  return *world;
}

std::string error_of(const Family& family, double radius = 0.3) {
  const auto world = generate(family, 1, radius);
  return world ? "" : world.error().message;
}

// Returns a hash over the bits of all numbers.
std::uint64_t hash_of(const WorldModel& world) {
  orca::Fnv1a hash;
  const auto add = [&](double value) { hash.add_u64(std::bit_cast<std::uint64_t>(value)); };
  for (const Obstacle& o : world.obstacles) {
    const auto* circle = std::get_if<Circle>(&o.shape);
    const auto* box = std::get_if<Box>(&o.shape);
    REQUIRE((circle != nullptr || box != nullptr));
    if (circle != nullptr)
      for (const double v : {circle->center.x, circle->center.y, circle->radius, o.height}) add(v);
    if (box != nullptr)
      for (const double v : {box->pose.x, box->pose.y, box->pose.yaw, box->half.x, box->half.y, o.height})
        add(v);
  }
  for (const Place& p : world.places)
    for (const double v : {p.pose.x, p.pose.y, p.pose.yaw}) add(v);
  return hash.value();
}

// Returns whether every ray from the start hits something.
bool closed(const WorldModel& world) {
  const Caster caster(world);
  for (int i = 0; i < 3600; ++i) {
    const Ray ray{world.place("start")->pose.position(), direction(i * 0.1 * std::numbers::pi / 180.0), 1e3,
                  0.2};
    if (!caster.cast(ray).found()) return false;
  }
  return true;
}

WorldModel read(const std::string& element, std::optional<std::uint64_t> seed = {}) {
  orca::xml::Diagnostics diagnostics;
  const auto world =
      read_world_text("<world name='w' version='1'>" + element + "</world>", "w.xml", diagnostics, seed);
  INFO(diagnostics.text());
  REQUIRE(world);
  return *world;
}

}  // namespace

TEST_CASE("in a world of each family a robot of 0.3 m can get from the start to every place",
          "[sim][generate]") {
  for (const Family& family : kFamilies) {
    for (std::uint64_t seed = 1; seed <= (orca::test::is_slow_run() ? 5 : 1); ++seed) {
      CAPTURE(family.index(), seed);
      const WorldModel world = made(family, seed);
      REQUIRE(world.place("start") != nullptr);
      REQUIRE(world.place("goal") != nullptr);
      const Plan plan(world, world.place("start")->pose.position(), 0.3);
      for (const Place& place : world.places) CHECK(plan.reaches(place.pose.position()));
      CHECK_FALSE(plan.reaches({-50.0, -50.0}));
    }
  }
}

TEST_CASE("a way is as wide as requested", "[sim][generate]") {
  for (const double radius : {0.15, 0.36, 0.4}) {
    for (std::uint64_t seed = 1; seed <= (orca::test::is_slow_run() ? 3 : 1); ++seed) {
      CAPTURE(radius, seed);
      const WorldModel world = made(BarnField{0.2, 4}, seed, radius);
      CHECK(Plan(world, world.place("start")->pose.position(), radius)
                .reaches(world.place("goal")->pose.position()));
    }
  }
}

TEST_CASE("generated worlds are closed all round", "[sim][generate]") {
  for (const Family& family : kFamilies)
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      CAPTURE(family.index(), seed);
      CHECK(closed(made(family, seed)));
    }
}

TEST_CASE("the same seed gives the same world bit for bit, another seed another", "[sim][generate]") {
  for (const Family& family : kFamilies) {
    CAPTURE(family.index());
    CHECK(hash_of(made(family, 7)) == hash_of(made(family, 7)));
    CHECK(hash_of(made(family, 7)) != hash_of(made(family, 8)));
  }
}

TEST_CASE("the first world of each family is the one whose hash is recorded here", "[sim][generate]") {
  std::vector<std::uint64_t> hashes;
  for (const Family& family : kFamilies) hashes.push_back(hash_of(made(family, 1)));
  CHECK(hashes == std::vector<std::uint64_t>{0xe970f39bd3c441d2, 0x6aef502b65eb4880, 0xd0bc81fe847bd34f,
                                             0x4cd6f0fe05c6ac2f, 0x04fe4e9c94776467});
}

TEST_CASE("a field of cylinders lies in BARN's frame and is filled as requested", "[sim][generate]") {
  const WorldModel sparse = made(BarnField{0.0, 0}, 1);
  const WorldModel dense = made(BarnField{0.2, 0}, 1, 0.05);
  const auto in_field = static_cast<double>(dense.obstacles.size() - sparse.obstacles.size());
  CHECK(in_field == Approx(0.2 * 30 * 28).margin(60));  // 4 deviations of that many draws are 52.
  for (const Obstacle& o : dense.obstacles) {
    const Circle& c = std::get<Circle>(o.shape);
    CHECK(c.radius == 0.075);
    CHECK(c.center.x > -4.5);
    CHECK(c.center.x < 0.0);
  }
  CHECK(dense.place("start")->pose.position() == Vec2{-2.25, 3.0});
  CHECK(dense.place("goal")->pose.position() == Vec2{-2.25, 13.0});
}

TEST_CASE("smoothing leaves no cylinder of a field alone", "[sim][generate]") {
  const auto alone = [](const WorldModel& world) {
    return std::ranges::count_if(world.obstacles, [&](const Obstacle& o) {
      const Vec2 p = std::get<Circle>(o.shape).center;
      return std::ranges::none_of(world.obstacles, [&](const Obstacle& other) {
        const double apart = norm(std::get<Circle>(other.shape).center - p);
        return apart > 0.01 && apart < 0.22;
      });
    });
  };
  CHECK(alone(made(BarnField{0.15, 0}, 2, 0.05)) > 0);
  CHECK(alone(made(BarnField{0.15, 4}, 2)) == 0);
}

TEST_CASE("the trap stands across the straight way from start to goal", "[sim][generate]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const WorldModel world = made(UTrap{}, seed);
    const Vec2 start = world.place("start")->pose.position();
    const Vec2 way = world.place("goal")->pose.position() - start;
    const Ray ray{start, 1.0 / norm(way) * way, norm(way), 0.2};
    CHECK(Caster(world).cast(ray).found());
  }
}

TEST_CASE("a hall has the requested number of doors of the requested width", "[sim][generate]") {
  const WorldModel world = made(NarrowDoors{.door = 0.9, .walls = 4}, 3);
  const Vec2 start = world.place("start")->pose.position();
  CHECK(world.obstacles.size() == 4 + 2 * 4);
  CHECK(Plan(world, start, 0.42).reaches(world.place("goal")->pose.position()));
  CHECK_FALSE(Plan(world, start, 0.46).reaches(world.place("goal")->pose.position()));
}

TEST_CASE("a corridor has the requested width at each of its bends", "[sim][generate]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const WorldModel world = made(Corridor{.width = 1.0, .legs = 9}, seed);
    const Vec2 start = world.place("start")->pose.position();
    CHECK(Plan(world, start, 0.45).reaches(world.place("goal")->pose.position()));
    CHECK_FALSE(Plan(world, start, 0.51).reaches(world.place("goal")->pose.position()));
  }
}

TEST_CASE("an office has rooms on both sides, each with a place in its middle", "[sim][generate]") {
  const WorldModel world = made(OfficeFloor{.rooms = 4}, 5);
  CHECK(world.places.size() == 2 + 8);
  for (int room = 1; room <= 8; ++room) CHECK(world.place("room_" + std::to_string(room)) != nullptr);
  const auto furniture = std::ranges::count(world.obstacles, "furniture", &Obstacle::name);
  CHECK(furniture > 8);
  CHECK(furniture <= 24);
}

TEST_CASE("values that no world can have are refused with their reason", "[sim][generate]") {
  CHECK(error_of(NarrowDoors{.door = 0.6}) == "door is 0.6 m; a robot of radius 0.3 m needs 0.7 m");
  CHECK_THAT(error_of(NarrowDoors{.walls = 0}), Catch::Contains("between 1 and 50"));
  CHECK_THAT(error_of(NarrowDoors{.width = 1.0}), Catch::Contains("that of a door"));
  CHECK_THAT(error_of(BarnField{.fill = 0.6}), Catch::Contains("between 0 and 0.5"));
  CHECK_THAT(error_of(BarnField{.rounds = 21}), Catch::Contains("at most 20"));
  CHECK_THAT(error_of(Corridor{.legs = 0}), Catch::Contains("between 1 and 50"));
  CHECK_THAT(error_of(Corridor{.shortest = 1.0}), Catch::Contains("at least 3.2 m"));
  CHECK_THAT(error_of(UTrap{.beside = 0.2}), Catch::Contains("beside is 0.2 m"));
  CHECK_THAT(error_of(OfficeFloor{.rooms = 11}), Catch::Contains("between 1 and 10"));
  CHECK_THAT(error_of(OfficeFloor{}, 0.0), Catch::Contains("more than 0 m"));
  CHECK_THAT(error_of(BarnField{0.5, 4}, 0.6), Catch::Contains("100 draws"));
}

TEST_CASE("a world file generates with its own seed, or with the requested one", "[sim][generate]") {
  const std::string element = "<generate kind='corridor' seed='4' legs='3' width='120 cm'/>";
  const Corridor same{.width = 1.2, .legs = 3};
  CHECK(hash_of(read(element)) == hash_of(made(same, 4)));
  CHECK(hash_of(read(element, 9)) == hash_of(made(same, 9)));
}

TEST_CASE("generated obstacles stand beside those that a world file draws", "[sim][generate]") {
  const WorldModel world =
      read("<generate kind='u_trap'/><cylinder name='post' x='9' y='0.4' radius='0.1'/>");
  CHECK(world.obstacles.back().name == "post");
  CHECK(world.place("goal") != nullptr);
}
