// SPDX-License-Identifier: GPL-3.0-or-later
// People who walk about.
#include <catch2/catch.hpp>

#include "orca/base/hash.hpp"
#include "orca/sim/world.hpp"
#include "orca/sim/world_file.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::Vec2;
using namespace orca::sim::test;
using std::chrono::seconds;

namespace {

// On the line y = 2 of the test room, there and back in 8 s.
Walker anna() {
  Walker walker{.name = "anna", .track = {{-2, 2}, {2, 2}}};
  walker.start = orca::Duration{0};
  return walker;
}

WorldModel room_with(const Walker& walker) {
  WorldModel model = test_room();
  model.walkers = {walker};
  return model;
}

void run(World& world, double time) {
  for (int i = 0; i < static_cast<int>(time * 100.0 + 0.5); ++i) world.step();
}

// Returns the place of the walker: the one circle of the snapshot that is not the room's post.
Vec2 place(const World& world) { return world.snapshot().circles.at(1).center; }

Vec2 place_after(const Walker& walker, double time, std::uint64_t seed = 1) {
  World world(room_with(walker), {.seed = seed, .realism = Realism::nominal});
  run(world, time);
  return place(world);
}

void check_at(Vec2 found, Vec2 expected) {
  CHECK(found.x == Approx(expected.x).margin(1e-9));
  CHECK(found.y == Approx(expected.y).margin(1e-9));
}

std::string errors_of_walker(const std::string& content) {
  orca::xml::Diagnostics diagnostics;
  CHECK_FALSE(read_world_text("<world name='w' version='1'>\n" + content + "</world>", "w.xml", diagnostics)
                  .has_value());
  return diagnostics.text();
}

}  // namespace

TEST_CASE("a walker goes along its track at its speed, there and back", "[sim][walker]") {
  check_at(place_after(anna(), 0.0), {-2, 2});
  check_at(place_after(anna(), 1.5), {-0.5, 2});
  check_at(place_after(anna(), 4.0), {2, 2});
  check_at(place_after(anna(), 5.0), {1, 2});
  check_at(place_after(anna(), 9.0), {-1, 2});
}

TEST_CASE("a walker that goes round comes from the last corner to the first", "[sim][walker]") {
  Walker walker = anna();
  walker.track = {{-2, -2}, {1, -2}, {1, 2}};
  walker.round = true;  // The way home is 5 m long.
  check_at(place_after(walker, 7.0), {1, 2});
  check_at(place_after(walker, 9.5), {-0.5, 0});
  check_at(place_after(walker, 12.0), {-2, -2});
}

TEST_CASE("the place at which a walker begins is drawn from the run's seed, or from its own",
          "[sim][walker]") {
  Walker walker = anna();
  walker.start.reset();
  CHECK(place_after(walker, 1.0, 1) == place_after(walker, 1.0, 1));
  CHECK_FALSE(place_after(walker, 1.0, 1) == place_after(walker, 1.0, 2));
  walker.seed = 5;
  CHECK(place_after(walker, 1.0, 1) == place_after(walker, 1.0, 2));
}

TEST_CASE("a walker rests at its corners for no longer than it may", "[sim][walker]") {
  Walker walker = anna();
  walker.pause = seconds{3};
  World world(room_with(walker), {.seed = 1, .realism = Realism::nominal});
  run(world, 4.0);
  const Vec2 corner = place(world);
  check_at(corner, {2, 2});
  double rest = 0.0;
  for (; place(world) == corner && rest < 10.0; rest += 0.01) world.step();
  CHECK(rest > 0.05);
  CHECK(rest < 3.02);
}

TEST_CASE("rays meet a walker up to its height, and no longer meet it where it was", "[sim][walker]") {
  World world(room_with(anna()), {.seed = 1, .realism = Realism::nominal});
  run(world, 2.0);
  const auto range = [&](double height) {
    return world.caster().cast({{0, -1}, {0, 1}, 10.0, height}).range;
  };
  CHECK(range(0.3) == Approx(2.75));
  CHECK(range(1.9) == Approx(6.0));
  run(world, 1.0);
  CHECK(range(0.3) == Approx(6.0));
}

TEST_CASE("a walker that meets a robot pushes it, and the contact is reported with the walker's name",
          "[sim][walker]") {
  World world(room_with(anna()), {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", scout(), {0, 2, 0});
  std::vector<std::string> told;
  for (int i = 0; i < 350; ++i) {
    world.step();
    for (const ContactEvent& e : world.contacts()) told.push_back(e.robot + "-" + e.other);
  }
  CHECK(told == std::vector<std::string>{"dewey-anna"});
  CHECK(norm(world.pose(id).position() - place(world)) > 0.25 + 0.205 - 0.02);
  CHECK(world.pose(id).x > 0.3);
}

TEST_CASE("a walker that stops for robots waits until the way is free", "[sim][walker]") {
  Walker walker = anna();
  walker.stops = 0.5;
  World world(room_with(walker), {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", scout(), {0, 2, 0.5 * std::numbers::pi});
  for (int i = 0; i < 500; ++i) {
    world.step();
    REQUIRE(world.contacts().empty());
  }
  const double gap = -place(world).x - 0.25 - 0.205;
  CHECK(gap < 0.5);
  CHECK(gap > 0.48);
  REQUIRE(world.set_velocity_command(id, 0.5, 0.0));
  run(world, 4.0);
  CHECK(place(world).x > 0.0);
}

TEST_CASE("two walkers who meet on one line make room for each other, each by its share, and come back to it",
          "[sim][walker][yields]") {
  // What is lacking is 0.25 + 0.25 + 0.3 m.
  for (const auto& [one, other] : {std::pair{0.5, 0.5}, std::pair{1.0, 0.0}, std::pair{0.25, 0.75}}) {
    CAPTURE(one, other);
    WorldModel model{"plane", {}, {}};
    model.walkers = {
        {.name = "anna", .track = {{-4, 0}, {4, 0}}, .start = orca::Duration{0}, .yields = one},
        {.name = "bert", .track = {{4, 0}, {-4, 0}}, .start = orca::Duration{0}, .yields = other}};
    World world(model, {.seed = 1, .realism = Realism::ideal});
    double nearest = 8.0, anna_aside = 0.0, bert_aside = 0.0;
    for (int i = 0; i < 700; ++i) {
      world.step();
      const std::vector<Person> people = people_in(world);
      nearest = std::min(nearest, norm(people[0].position - people[1].position));
      anna_aside = std::min(anna_aside, people[0].position.y);
      bert_aside = std::max(bert_aside, people[1].position.y);
    }
    CHECK(nearest > 0.75);
    CHECK(nearest < 0.85);
    CHECK(anna_aside == Approx(-0.8 * one).margin(0.03));
    CHECK(bert_aside == Approx(0.8 * other).margin(0.03));
    for (const Person& person : people_in(world)) CHECK(std::fabs(person.position.y) < 0.01);
  }
}

TEST_CASE("walkers who yield nothing walk through each other", "[sim][walker][yields]") {
  WorldModel model{"plane", {}, {}};
  model.walkers = {{.name = "anna", .track = {{-2, 0}, {2, 0}}, .start = orca::Duration{0}},
                   {.name = "bert", .track = {{2, 0}, {-2, 0}}, .start = orca::Duration{0}}};
  World world(model, {.seed = 1, .realism = Realism::ideal});
  run(world, 2.0);
  CHECK(norm(people_in(world)[0].position - people_in(world)[1].position) < 0.03);
}

TEST_CASE("a walker who yields walks around a robot that stands in its way, and not into a wall",
          "[sim][walker][yields]") {
  Walker walker = anna();
  walker.yields = 1.0;
  WorldModel model{"plane", {}, {}};
  model.walkers = {walker};
  World free(model, {.seed = 1, .realism = Realism::ideal});
  REQUIRE(free.add_robot("dewey", scout(), {0, 2, 0}));
  for (int i = 0; i < 700; ++i) {
    free.step();
    REQUIRE(free.contacts().empty());
  }
  // On its right a wall leaves no room, so it goes as far as it can.
  model.obstacles.push_back({"wall", Box{{0, 1.6, 0}, {4, 0.05}}, 2.5});
  World narrow(model, {.seed = 1, .realism = Realism::ideal});
  REQUIRE(narrow.add_robot("dewey", scout(), {0, 2.1, 0}));
  double lowest = 2.0;
  for (int i = 0; i < 200; ++i) {
    narrow.step();
    lowest = std::min(lowest, people_in(narrow)[0].position.y);
  }
  CHECK(lowest > 1.65 + 0.25 - 1e-6);
}

TEST_CASE("a robot is not set down on a walker", "[sim][walker]") {
  World world(room_with(anna()), {.seed = 1, .realism = Realism::ideal});
  const auto added = world.add_robot("dewey", scout(), {-1.8, 2, 0});
  REQUIRE_FALSE(added);
  CHECK_THAT(added.error().message, Catch::Contains("it would stand in 'anna'"));
}

TEST_CASE("worlds with walkers and robots among them are bit-identical", "[sim][walker]") {
  const auto hash = [](std::uint64_t seed) {
    Walker walker = anna();
    walker.start.reset();
    walker.pause = seconds{2};
    World world(room_with(walker), {.seed = seed, .realism = Realism::nominal});
    const RobotId id = *world.add_robot("dewey", scout(), {0, -1, 0.5 * std::numbers::pi});
    REQUIRE(world.set_velocity_command(id, 0.3, 0.02));
    orca::Fnv1a trace;
    for (int i = 0; i < 3000; ++i) {
      world.step();
      trace.add_u64(world.state_hash());
    }
    return trace.value();
  };
  CHECK(hash(3) == hash(3));
  CHECK(hash(3) != hash(4));
}

TEST_CASE("a world file defines walkers with all their attributes", "[sim][walker][world_file]") {
  orca::xml::Diagnostics diagnostics;
  const auto world = read_world_text(
      "<world name='w' version='1'><walker name='bob' track='0 0; 4 0; 4 3' speed='1.2 m/s' radius='30 cm' "
      "height='1.8 m' loop='round' pause='2 s' start='500 ms' seed='7' stops='0.6 m' yields='40 %'/></world>",
      "w.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(world);
  REQUIRE(world->walkers.size() == 1);
  const Walker& bob = world->walkers[0];
  CHECK(bob.name == "bob");
  CHECK(bob.track == std::vector<Vec2>{{0, 0}, {4, 0}, {4, 3}});
  CHECK(bob.speed == 1.2);
  CHECK(bob.radius == 0.3);
  CHECK(bob.height == 1.8);
  CHECK(bob.round);
  CHECK(bob.pause == seconds{2});
  CHECK(bob.start == std::chrono::milliseconds{500});
  CHECK(bob.seed == 7);
  CHECK(bob.stops == 0.6);
  CHECK(bob.yields == 0.4);
}

TEST_CASE("errors of a walker are reported at their place", "[sim][walker][world_file]") {
  CHECK_THAT(errors_of_walker("<walker name='a' track='0 0; 1 0' loop='no'/>"),
             Catch::Contains("\"no\" is not one of: back, round"));
  CHECK_THAT(errors_of_walker("<walker name='a' track='0 0; 1 0' speed='0 m/s'/>"),
             Catch::Contains("speed: \"0 m/s\" is out of range: more than 0"));
  CHECK_THAT(errors_of_walker("<walker name='a' track='0 0'/>"),
             Catch::Contains("W019: a track needs at least 2 corners"));
  CHECK_THAT(errors_of_walker("<walker name='a' track='1 1; 1 1'/>"),
             Catch::Contains("W019: the track has no length"));
  CHECK_THAT(errors_of_walker("<walker track='0 0; 1 0'/>"), Catch::Contains("W004"));
  CHECK_THAT(errors_of_walker("<walker name='a' track='0 0; 1 0'/><walker name='a' track='0 2; 1 2'/>"),
             Catch::Contains("error W007"));
  CHECK_THAT(
      errors_of_walker(
          "<walker name='a' track='0 0; 4 0'/><box name='desk' x='2' y='0.3' length='1' width='0.4'/>"),
      Catch::Contains("w.xml:2:1: error W019: \"a\" would walk through obstacle \"desk\""));
}

namespace {

// Returns the legs of the walker: the circles of the snapshot after it.
std::pair<Circle, Circle> legs(const World& world) {
  const auto circles = world.snapshot().circles;
  REQUIRE(circles.size() == 4);
  return {circles[2], circles[3]};
}

// Returns the ranges that somebody sees who looks along y at the walker, from 1 m beside its track.
double range_at(const World& world, double x, double height) {
  return world.caster().cast({{x, 1.0}, {0.0, 1.0}, 5.0, height}).range;
}

Walker legged() {
  Walker walker = anna();
  walker.legs = 0.12;
  return walker;
}

}  // namespace

TEST_CASE("a walker with legs is two legs up to half of its height, and the cylinder above",
          "[sim][walker]") {
  World world(room_with(legged()), {.seed = 1, .realism = Realism::nominal});
  CHECK(range_at(world, -2.0, 0.3) == Approx(1.0 - 0.1 - 0.06));  // The right leg, beside the left one.
  CHECK(range_at(world, -2.0, 0.9) == Approx(1.0 - 0.25));
  CHECK(range_at(world, -2.2, 0.9) == Approx(1.0 - 0.15));
  CHECK(range_at(world, -2.2, 0.3) > 1.25);  // Beside the legs.
  CHECK(range_at(world, -2.0, 1.7) > 1.25);
}

TEST_CASE("the legs swing against each other as the walker walks, within its cylinder, and rest with it",
          "[sim][walker]") {
  Walker walker = legged();
  walker.pause = seconds{5};
  World world(room_with(walker), {.seed = 1, .realism = Realism::nominal});
  double most = 0.0;
  double least = 0.0;
  for (int i = 0; i < 200; ++i) {
    world.step();
    const auto [left, right] = legs(world);
    const Vec2 middle = place(world);
    check_at(left.center + right.center, 2.0 * middle);
    CHECK(norm(left.center - middle) + left.radius <= walker.radius + 1e-9);
    CHECK(left.center.y - middle.y == Approx(0.4 * walker.radius));
    const double ahead = left.center.x - middle.x;
    most = std::max(most, ahead);
    least = std::min(least, ahead);
    if (std::fabs(ahead) < left.radius) continue;  // The right leg hides it.
    CHECK(range_at(world, left.center.x, 0.3) == Approx(left.center.y - left.radius - 1.0).margin(1e-9));
  }
  const double room = std::sqrt(0.19 * 0.19 - 0.1 * 0.1);
  CHECK(most == Approx(room).margin(0.01));
  CHECK(least == Approx(-room).margin(0.01));
  run(world, 2.1);
  const auto rested = legs(world);
  world.step();
  CHECK(legs(world) == rested);
}

TEST_CASE("legs that would overlap are an error, and a world file says how wide they are", "[sim][walker]") {
  CHECK(
      errors_of_walker("<walker name='a' track='0 0; 1 0' radius='0.2 m' legs='0.17 m'/>").find("overlap") !=
      std::string::npos);
  orca::xml::Diagnostics diagnostics;
  const auto world =
      read_world_text("<world name='w' version='1'><walker name='a' track='0 0; 1 0' legs='12 cm'/></world>",
                      "w.xml", diagnostics);
  REQUIRE(world.has_value());
  CHECK(world->walkers[0].legs == 0.12);
}
