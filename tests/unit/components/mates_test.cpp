// SPDX-License-Identifier: GPL-3.0-or-later
// What a robot of a team makes of what the others say.
#include "teammates/mates.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/idl/time.hpp"

using namespace orca;
using team::Mates;

namespace {

constexpr TimePoint kNow{std::chrono::hours(1)};

idl::Teammate mate(const std::string& name, double x, double y, double yaw, double speed) {
  idl::Teammate mate;
  mate.origin(name);
  mate.name(name);
  mate.map_name("building");
  mate.pose().x(x);
  mate.pose().y(y);
  mate.pose().orientation(yaw);
  mate.translational_velocity(speed);
  mate.radius(0.3);
  mate.pose().stamp(to_time_value(kNow));
  return mate;
}

// What a robot lets pass that calls itself so and has its odometry where the map begins.
std::vector<idl::MovingThing> seen_by(const Mates& mates, const std::string& name, TimePoint at = kNow,
                                      const Pose2& X_OM = {}) {
  idl::MovingThings moving;
  mates.add({name, "building", X_OM, 0.0}, at, moving);
  return moving.things();
}

}  // namespace

TEST_CASE("a team-mate is where it has driven to since it spoke, in the frame of the odometry", "[team]") {
  Mates mates;
  mates.hear(mate("anna", 4.0, 2.0, std::numbers::pi / 2, 0.5), kNow);
  const Pose2 X_OM{1.0, 0.0, std::numbers::pi / 2};  // the map lies turned to the left in the odometry
  const auto things = seen_by(mates, "bert", kNow + 400ms, X_OM);
  REQUIRE(things.size() == 1);
  CHECK(things[0].x() == Approx(1.0 - 2.2));
  CHECK(things[0].y() == Approx(4.0));
  CHECK(things[0].velocity_x() == Approx(-0.5));
  CHECK(things[0].velocity_y() == Approx(0.0).margin(1e-9));
  CHECK(things[0].radius() == 0.3);
  CHECK(things[0].unseen() == Approx(0.4));
  CHECK(things[0].place_error() == Approx(0.04));
}

TEST_CASE("of two robots that know of each other the first by the alphabet goes first", "[team]") {
  Mates of_anna, of_bert;
  idl::Teammate bert = mate("bert", 4.0, 2.0, 0.0, 0.5);
  of_anna.hear(bert, kNow);
  CHECK(seen_by(of_anna, "anna").size() == 1);  // bert does not say that it knows of anna
  bert.hears({"anna"});
  of_anna.hear(bert, kNow);
  CHECK(seen_by(of_anna, "anna").empty());
  idl::Teammate anna = mate("anna", 2.0, 2.0, 0.0, 0.5);
  anna.hears({"bert"});
  of_bert.hear(anna, kNow);
  CHECK(seen_by(of_bert, "bert").size() == 1);
}

TEST_CASE("two robots that have taken one name let each other pass", "[team]") {
  Mates mates;
  idl::Teammate other = mate("anna", 2.0, 2.0, 0.0, 0.5);
  other.hears({"anna"});
  mates.hear(other, kNow);
  CHECK(seen_by(mates, "anna").size() == 1);
}

TEST_CASE("a team-mate keeps its number, and is forgotten when it is silent", "[team]") {
  Mates mates;
  mates.hear(mate("anna", 1.0, 0.0, 0.0, 0.0), kNow);
  mates.hear(mate("carl", 2.0, 0.0, 0.0, 0.0), kNow + 900ms);
  mates.forget(kNow + 1s, 1s);
  REQUIRE(seen_by(mates, "dora").size() == 2);
  const auto number = seen_by(mates, "dora")[1].number();
  CHECK(number != seen_by(mates, "dora")[0].number());
  mates.forget(kNow + 1001ms, 1s);
  CHECK(mates.names() == std::vector<std::string>{"carl"});
  mates.hear(mate("carl", 2.5, 0.0, 0.0, 0.0), kNow + 1100ms);
  CHECK(seen_by(mates, "dora")[0].number() == number);
}

TEST_CASE("robots of another map, and those that do not know where they are, are nowhere", "[team]") {
  Mates mates;
  idl::Teammate elsewhere = mate("anna", 1.0, 0.0, 0.0, 0.5);
  elsewhere.map_name("garden");
  mates.hear(elsewhere, kNow);
  CHECK(mates.names().size() == 1);
  CHECK(seen_by(mates, "bert").empty());
  idl::Teammate lost = mate("carl", 1.0, 0.0, 0.0, 0.5);
  lost.pose().covariance(anywhere());
  mates.hear(lost, kNow);
  CHECK(mates.names().size() == 1);
}

TEST_CASE("a team-mate whose instants are an hour away, or any numbers, is not noticed", "[team]") {
  Mates mates;
  constexpr std::int64_t kHour = 3'600'000'000'000;
  const std::int64_t now = to_time_value(kNow).ns();
  for (const std::int64_t ns : {INT64_MIN, INT64_MAX, now - kHour - 1, now + kHour + 1}) {
    idl::Teammate anna = mate("anna", 4.0, 2.0, 0.0, 0.5);
    anna.pose().stamp().ns(ns);
    mates.hear(anna, kNow);
    CHECK(seen_by(mates, "bert").empty());
  }
  mates.hear(mate("anna", 4.0, 2.0, 0.0, 0.5), kNow + 59min);
  CHECK(seen_by(mates, "bert").size() == 1);
}
