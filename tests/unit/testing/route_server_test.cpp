// SPDX-License-Identifier: GPL-3.0-or-later
// Routes that a RouteServer answers, and the doors that it sees.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/idl/ways.hpp"
#include "orca/testing/component_trial.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

using Names = std::vector<std::string>;

// Two rooms, 6 m by 6 m, south and north of a wall at y = 6 m that has a door at x = 1 m and another at x = 5 m.
Loan<idl::OccupancyGrid> rooms_with_doors() {
  constexpr std::uint32_t kRows = 120;
  auto map = make_object<idl::OccupancyGrid>();
  map->name("rooms");
  map->resolution(0.1);
  map->columns(60);
  map->rows(kRows);
  map->cells().resize(std::size_t{60} * kRows);
  for (std::uint32_t column = 0; column < 60; ++column) {
    const bool is_door = (column >= 6 && column < 14) || (column >= 46 && column < 54);
    if (!is_door) map->cells()[std::size_t{60} * 60 + column] = 100;
  }
  return map;
}

// Doors that lead north, and the leg from one to the other on either side.
const char* const kWays = R"(<ways name="rooms" version="1">
  <door name="west" x="1 m" y="6.05 m" yaw="90 deg" width="0.8 m" from="south" into="north"/>
  <door name="east" x="5 m" y="6.05 m" yaw="90 deg" width="0.8 m" from="south" into="north"/>
  <leg from="west" to="east" in="south"/>
  <leg from="west" to="east" in="north"/>
</ways>)";

struct WayRobot final : Partner {
  using Partner::Partner;
  PushServer<idl::RobotPose> localizer{*this, "localizer"};
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushServer<idl::OccupancyGrid> world{*this, "world"};
  QueryProxy<idl::GoalPoint, idl::Route> routes{*this, "RouteQuery"};
  SendProxy<idl::Route> blocked{*this, "BlockedSend"};
  PushProxy<idl::Door> doors{*this, "DoorPush", {.depth = 16}};

  void stand(double x, double y) {
    auto here = localizer.loan();
    here->x(x);
    here->y(y);
    here->orientation(std::numbers::pi / 2.0);
    here->stamp(to_time_value(now()));
    localizer.push(std::move(here));
    sleep(50ms);
  }

  /// Looks north with a scan of a beam per degree for a time, from 3 m before the wall; `shut` is the door that is.
  void look(double x, Duration time, bool shut) {
    for (const TimePoint end = now() + time; now() < end;) {
      auto scan = laser.loan();
      scan->stamp(to_time_value(now()));
      scan->min_range(0.1);
      scan->max_range(8.0);
      scan->angle_start(-std::numbers::pi / 6.0);
      scan->angle_increment(std::numbers::pi / 180.0);
      for (int i = 0; i <= 60; ++i) {
        const double angle = scan->angle_start() + i * scan->angle_increment();
        const double across = x - 3.0 * std::tan(angle);
        const bool is_open = !shut && std::min(std::fabs(across - 1.0), std::fabs(across - 5.0)) < 0.4;
        scan->ranges().push_back(is_open ? 8.0 : 3.0 / std::cos(angle));
      }
      laser.push(std::move(scan));
      stand(x, 3.05);
      stand(x, 3.05);
    }
  }

  Result<ObjectPtr<idl::Route>> ask(const std::string& name, double x, double y) {
    auto goal = routes.loan();
    goal->name(name);
    goal->coordinate().point().x(x);
    goal->coordinate().point().y(y);
    return routes.query(std::move(goal));
  }
  /// Returns the places on the way to a goal in the north.
  Names way_to(double x, double y) {
    const auto route = ask("goal", x, y);
    if (!route) return {route.error().message};
    Names names;
    for (const auto& leg : (*route)->legs()) names.push_back(leg.name());
    return names;
  }
  bool is_blocked(double x, double y) { return ask("goal", x, y).value()->blocked(); }
};

void try_routes(const std::function<void(WayRobot&)>& check, const std::string& ways = kWays) {
  const test::TempFolder folder;
  try_component<WayRobot>({.type = "orca.RouteServer",
                           .params = {{"ways", folder.write("ways.xml", ways)}, {"forget_after", "20 s"}}},
                          check);
}

}  // namespace

TEST_CASE("a route leads through the doors of the shortest way, and says what each leg costs",
          "[testing][routes]") {
  try_routes([](WayRobot& robot) {
    CHECK_FALSE((*robot.ask("goal", 1.0, 9.0))->known());  // It knows neither the world nor the pose.
    robot.world.push(rooms_with_doors());
    robot.stand(1.0, 3.0);
    const auto route = robot.ask("goal", 1.0, 9.0);
    REQUIRE(route);
    CHECK((*route)->known());
    REQUIRE((*route)->legs().size() == 1);
    const idl::RouteLeg& leg = (*route)->legs().front();
    CHECK(leg.name() == "west");
    CHECK(leg.door());
    CHECK(leg.width() == Approx(0.8));
    CHECK(leg.direction() == Approx(std::numbers::pi / 2.0));
    CHECK(leg.cost() == Approx(3.05).margin(0.4));
    CHECK((*route)->cost() == Approx(6.0).margin(0.8));
    CHECK(robot.way_to(5.0, 7.0) == Names{"east"});
    CHECK(robot.way_to(5.0, 3.0) == Names{});  // in the same room
  });
}

TEST_CASE("a door that is seen to be shut is avoided within 2 s, until it is seen open",
          "[testing][routes]") {
  try_routes([](WayRobot& robot) {
    robot.doors.subscribe();
    robot.world.push(rooms_with_doors());
    robot.look(1.0, 500ms, false);
    CHECK(robot.way_to(1.0, 9.0) == Names{"west"});
    const TimePoint begin = robot.now();
    while (robot.way_to(1.0, 9.0) == Names{"west"} && robot.now() - begin < 5s) robot.look(1.0, 100ms, true);
    CHECK(to_seconds(robot.now() - begin) < 2.0);
    CHECK(robot.way_to(1.0, 9.0) == Names{"east"});
    REQUIRE(robot.doors.new_data_arrived());
    const auto shut = robot.doors.get_update();
    CHECK(shut->name() == "west");
    CHECK_FALSE(shut->passable());
    robot.look(1.0, 300ms, false);
    CHECK(robot.way_to(1.0, 9.0) == Names{"west"});
    REQUIRE(robot.doors.new_data_arrived());
    CHECK(robot.doors.get_update()->passable());
  });
}

TEST_CASE("somebody who walks through a door shuts none", "[testing][routes]") {
  try_routes([](WayRobot& robot) {
    robot.world.push(rooms_with_doors());
    for (int i = 0; i < 3; ++i) {
      robot.look(1.0, 700ms, true);
      robot.look(1.0, 300ms, false);
    }
    CHECK(robot.way_to(1.0, 9.0) == Names{"west"});
  });
}

TEST_CASE("a shut door that nobody looks at is forgotten after a while", "[testing][routes]") {
  try_routes([](WayRobot& robot) {
    robot.world.push(rooms_with_doors());
    robot.look(1.0, 1500ms, true);
    CHECK(robot.way_to(1.0, 9.0) == Names{"east"});
    robot.sleep(15s);
    robot.stand(1.0, 3.0);
    CHECK(robot.way_to(1.0, 9.0) == Names{"east"});
    robot.sleep(10s);
    robot.stand(1.0, 3.0);
    CHECK(robot.way_to(1.0, 9.0) == Names{"west"});
  });
}

TEST_CASE("a leg that is reported as blocked is avoided", "[testing][routes]") {
  try_routes([](WayRobot& robot) {
    robot.world.push(rooms_with_doors());
    robot.stand(1.0, 3.0);
    auto leg = robot.blocked.loan();
    leg->legs().emplace_back().name("west");
    REQUIRE(robot.blocked.send(std::move(leg)).ok());
    CHECK(robot.way_to(1.0, 9.0) == Names{"east"});
  });
}

namespace {

// Reports that the last leg to a goal is blocked, where the robot stands.
void report_last_leg(WayRobot& robot, const std::string& from, double x, double y) {
  auto leg = robot.blocked.loan();
  leg->name(from);
  idl::RouteLeg& last = leg->legs().emplace_back();
  last.x(x);
  last.y(y);
  REQUIRE(robot.blocked.send(std::move(leg)).ok());
}

}  // namespace

TEST_CASE("a last leg that is blocked is avoided on the way to that goal, whatever its name, and to no other",
          "[testing][routes]") {
  try_routes([](WayRobot& robot) {
    robot.world.push(rooms_with_doors());
    robot.stand(1.0, 5.0);
    CHECK(robot.way_to(2.0, 9.0) == Names{"west"});
    robot.stand(1.0, 7.0);  // It has passed the door.
    CHECK(robot.way_to(2.0, 9.0) == Names{});
    report_last_leg(robot, "west", 2.0, 9.0);
    robot.stand(1.0, 3.0);
    CHECK(robot.way_to(2.0, 9.0) == Names{"east"});
    CHECK(robot.way_to(2.0, 8.0) == Names{"west"});
    robot.sleep(25s);
    robot.stand(1.0, 3.0);
    CHECK(robot.way_to(2.0, 9.0) == Names{"west"});  // forgotten
  });
}

TEST_CASE("last legs that lead by where a robot was blocked before its goal are blocked, too",
          "[testing][routes]") {
  try_routes([](WayRobot& robot) {
    robot.world.push(rooms_with_doors());
    robot.stand(1.0, 8.0);
    report_last_leg(robot, "west", 1.0, 9.0);
    robot.stand(1.0, 3.0);
    CHECK(robot.way_to(1.0, 9.0) == Names{"west"});
    CHECK(robot.is_blocked(1.0, 9.0));
    CHECK_FALSE(robot.is_blocked(5.0, 9.0));
  });
}

TEST_CASE("a robot that is blocked before its goal gets another way, over a place in the same room",
          "[testing][routes]") {
  const std::string ways = std::string(kWays).insert(
      std::string(kWays).find("  <leg"), R"(  <place name="corner" x="5 m" y="9 m" in="north"/>)");
  try_routes(
      [](WayRobot& robot) {
        robot.world.push(rooms_with_doors());
        robot.stand(1.0, 7.5);
        CHECK(robot.way_to(2.0, 9.0) == Names{});
        report_last_leg(robot, "west", 2.0, 9.0);
        CHECK(robot.way_to(2.0, 9.0) == Names{"corner"});
        CHECK_FALSE(robot.is_blocked(2.0, 9.0));
        report_last_leg(robot, "corner", 2.0, 9.0);
        report_last_leg(robot, "east", 2.0, 9.0);
        CHECK(robot.is_blocked(2.0, 9.0));
        CHECK_FALSE(robot.is_blocked(4.0, 9.0));
        robot.stand(5.0, 9.0);
        CHECK(robot.way_to(2.0, 9.0) == Names{});
      },
      ways);
}

TEST_CASE("with all doors shut the route leads to the best one: the robot waits there", "[testing][routes]") {
  try_routes([](WayRobot& robot) {
    robot.world.push(rooms_with_doors());
    robot.look(1.0, 1500ms, true);
    robot.look(5.0, 1500ms, true);
    robot.stand(1.0, 3.0);
    CHECK(robot.way_to(1.0, 9.0) == Names{"west"});
  });
}
