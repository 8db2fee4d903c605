// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "command/goal_list.hpp"
#include "orca/base/random.hpp"

using Catch::Contains;
using orca::go::parse_trip;
using orca::go::Trip;

TEST_CASE("a trip is a name and a goal in metres", "[components][goals]") {
  const Trip trip = parse_trip("kitchen: 5 -4.5").value();
  CHECK(trip.name == "kitchen");
  CHECK(trip.goal.x == 5.0);
  CHECK(trip.goal.y == -4.5);
  CHECK(trip.via.empty());
  CHECK_FALSE(trip.use_orientation);
}

TEST_CASE("places before the last > are via points, in order", "[components][goals]") {
  const Trip trip = parse_trip("k_2: 3.1 2 > 5 2 > 5 4.5").value();
  REQUIRE(trip.via.size() == 2);
  CHECK(trip.via[0].x == 3.1);
  CHECK(trip.via[1].y == 2.0);
  CHECK(trip.goal.y == 4.5);
}

TEST_CASE("the number after @ is the direction to face, in degrees", "[components][goals]") {
  const Trip trip = parse_trip("door: 1 2 @ -90").value();
  CHECK(trip.use_orientation);
  CHECK(trip.orientation == Approx(-std::numbers::pi / 2));
}

TEST_CASE("a third number is the height of the place above the floor", "[components][goals]") {
  const Trip trip = parse_trip("shelf: 1 2 > 3 4 0.8 @ 90").value();
  CHECK(trip.goal.z == 0.8);
  CHECK(trip.via.at(0).z == 0.0);
}

TEST_CASE("a place may be a doorway: its middle, the direction through it, and its width",
          "[components][goals]") {
  const Trip trip = parse_trip("lab: 2 3 > door 2 4.5 90 0.95 > 2 6.5 @ 0").value();
  REQUIRE(trip.via.size() == 2);
  CHECK_FALSE(trip.via[0].door);
  REQUIRE(trip.via[1].door);
  CHECK(trip.via[1].x == 2.0);
  CHECK(trip.via[1].y == 4.5);
  CHECK(trip.via[1].door->direction == Approx(std::numbers::pi / 2));
  CHECK(trip.via[1].door->width == 0.95);
  CHECK_FALSE(trip.goal.door);
  CHECK(parse_trip("lab_door: door 2 4.5 -90 1").value().goal.door->direction ==
        Approx(-std::numbers::pi / 2));
}

TEST_CASE("a place by its name is a goal, and names it", "[components][goals]") {
  const Trip trip = parse_trip("kitchen").value();
  CHECK(trip.name == "kitchen");
  CHECK(trip.goal.name == "kitchen");
  CHECK(trip.via.empty());
  CHECK(parse_trip(" hall > kitchen @ 90\r").value().name == "kitchen");
}

TEST_CASE("places by name and coordinates mix, and the goal may have a name of its own",
          "[components][goals]") {
  const Trip trip = parse_trip("lunch: hall > 3 7.6 > kitchen").value();
  CHECK(trip.name == "lunch");
  REQUIRE(trip.via.size() == 2);
  CHECK(trip.via[0].name == "hall");
  CHECK(trip.via[1].name.empty());
  CHECK(trip.via[1].y == 7.6);
  CHECK(trip.goal.name == "kitchen");
}

TEST_CASE("spaces and tabs do not matter, nor the end of a DOS line", "[components][goals]") {
  const Trip tight = parse_trip("a:1 2>3 4@5").value();
  const Trip loose = parse_trip("  a :\t1   2 >  3\t4  @  5 \r").value();
  CHECK(loose.name == tight.name);
  CHECK(loose.via.at(0).x == tight.via.at(0).x);
  CHECK(loose.goal.y == tight.goal.y);
  CHECK(loose.orientation == tight.orientation);
}

TEST_CASE("a wrong trip is refused with what was found and an example", "[components][goals]") {
  struct Wrong {
    const char* text;
    const char* why;
  };
  const Wrong wrong =
      GENERATE(Wrong{"", "no \":\""}, Wrong{"kitchen 1 2", "no \":\""}, Wrong{"hall > 1 2", "no \":\""},
               Wrong{"kitchen >", "no \":\""}, Wrong{": 1 2", "\"\" is no name"},
               Wrong{"2nd: 1 2", "\"2nd\" is no name"}, Wrong{"my goal: 1 2", "\"my goal\" is no name"},
               Wrong{"a:", "expected \"x y\", found \"\""}, Wrong{"a: 1", "found \"1\""},
               Wrong{"a: 1 2 3 4", "expected nothing after x, y and z, found \"4\""},
               Wrong{"a: 1,5 2", "\"1,5\" is not a number"}, Wrong{"a: 10abc 2", "\"10abc\" is not a number"},
               Wrong{"a: nan 2", "\"nan\" is not a number"}, Wrong{"a: 1 inf", "\"inf\" is not a number"},
               Wrong{"a: 1e9 2", "farther away than any place on Earth"},
               Wrong{"a: 1 2 > door 3 -1e300 90 1 > 3 4", "farther away than any place on Earth"},
               Wrong{"a: 1e999 2", "\"1e999\" is not a number"}, Wrong{"a: > 1 2", "found \"\""},
               Wrong{"a: 1 2 > > 3 4", "found \"\""}, Wrong{"a: 1 2 >", "found \"\""},
               Wrong{"a: 1 2 @ north", "\"north\" is not a number"},
               Wrong{"a: 1 2 @", "\"\" is not a number"}, Wrong{"a: 1 2 @ 3 @ 4", "is not a number"});
  CAPTURE(wrong.text);
  const auto trip = parse_trip(wrong.text);
  REQUIRE_FALSE(trip.has_value());
  CHECK(trip.error().code == orca::Code::invalid_argument);
  CHECK_THAT(trip.error().text(), Contains(wrong.why) && Contains("kitchen: 3.1 2 > 5 4.5"));
}

TEST_CASE("whatever the text, a trip that is read has a name and finite numbers", "[components][goals]") {
  constexpr std::string_view kLetters = "ab:>@ \t.-+0123456789einf";
  orca::RandomStream random(1, "test", "goals");
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = random.chance(0.5) ? "a: 1 2" : "";
    for (std::uint64_t n = random() % 12; n > 0; --n) text += kLetters[random() % kLetters.size()];
    const auto trip = parse_trip(text);
    if (!trip) continue;
    ++read;
    CHECK_FALSE(trip->name.empty());
    CHECK(std::isfinite(trip->goal.x + trip->goal.y + trip->orientation));
  }
  CHECK(read > 100);
}

TEST_CASE("goals that are added come after the others of the round that is driven", "[command]") {
  const auto trips = [](const std::vector<std::string>& names) {
    std::vector<Trip> all;
    for (const std::string& name : names) all.push_back(*parse_trip(name + ": 1 2"));
    return all;
  };
  const auto next = [](const orca::command::Agenda& agenda) { return agenda.next(0)->name; };
  orca::command::Agenda agenda;
  agenda.set(trips({"a", "b"}));
  for (int begun = 0; begun < 3; ++begun) agenda.begin();  // on the way to a for the second time
  agenda.add(trips({"c"}));
  std::string driven;
  for (int i = 0; i < 5; ++i) {
    driven += next(agenda);
    agenda.begin();
  }
  CHECK(driven == "bcabc");

  orca::command::Agenda last;
  last.set(trips({"a", "b"}));
  for (int begun = 0; begun < 2; ++begun) last.begin();  // on the way to b
  last.add(trips({"c"}));
  CHECK(next(last) == "c");
}
