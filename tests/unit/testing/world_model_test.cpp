// SPDX-License-Identifier: GPL-3.0-or-later
// What a WorldModel pushes of the floor.
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

constexpr double kCell = 0.05;  // [m]

// Returns a free hall from the origin to x = 30 m, y = 6 m.
Loan<idl::OccupancyGrid> hall(std::uint32_t columns = 600, std::uint32_t rows = 120) {
  auto map = make_object<idl::OccupancyGrid>();
  map->name("hall");
  map->resolution(kCell);
  map->columns(columns);
  map->rows(rows);
  map->cells().resize(std::size_t{columns} * rows);
  return map;
}

std::size_t index_of(double x, double y) {
  return static_cast<std::size_t>(y / kCell) * 600 + static_cast<std::size_t>(x / kCell);
}

struct Senses : Partner {
  using Partner::Partner;
  PushServer<idl::RobotPose> localizer{*this, "localizer"};
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushServer<idl::OccupancyGrid> map{*this, "map"};
  PushProxy<idl::OccupancyGrid> pushed{*this, "OccupancyGridPush", {.depth = 64}};

  void stand(double x) {
    auto here = localizer.loan();
    here->x(x);
    here->y(3.0);
    here->stamp(to_time_value(now()));
    localizer.push(std::move(here));
    sleep(50ms);
  }
  /// Pushes a scan of three beams ahead, and the pose before and after it.
  void look(double x, double range) {
    stand(x);
    auto scan = laser.loan();
    scan->stamp(to_time_value(now()));
    scan->min_range(0.1);
    scan->max_range(8.0);
    scan->angle_start(-0.01);
    scan->angle_increment(0.01);
    scan->ranges() = {range, range, range};
    laser.push(std::move(scan));
    stand(x);
    stand(x);
  }
  /// Returns all that was pushed.
  std::vector<ObjectPtr<idl::OccupancyGrid>> take() {
    std::vector<ObjectPtr<idl::OccupancyGrid>> all;
    while (pushed.new_data_arrived()) all.push_back(pushed.get_update());
    return all;
  }
};

// The same with a bumper switch ahead, 0.28 m before the robot's middle.
struct Touching final : Senses {
  using Senses::Senses;
  PushServer<idl::BumperReadings> bumper{*this, "bumper"};

  void touch() {
    auto touched = bumper.loan();
    touched->stamp(to_time_value(now()));
    touched->pressed() = {1};
    touched->poses().resize(1);
    touched->poses()[0].position().x(0.28);
    bumper.push(std::move(touched));
    stand(3.0);
  }
  /// Returns the state of the cell at a place in the grid that was pushed last.
  int last_at(double x, double y) {
    for (const auto& grid : take()) last_ = grid;
    REQUIRE(last_);
    const auto cell = [&](double offset) { return static_cast<std::size_t>(offset / kCell + 1e-6); };
    return last_->cells()[cell(y - last_->corner().y()) * last_->columns() + cell(x - last_->corner().x())];
  }

 private:
  ObjectPtr<idl::OccupancyGrid> last_;
};

bool is_whole(const ObjectPtr<idl::OccupancyGrid>& grid) { return grid->columns() == 600; }

}  // namespace

TEST_CASE("a WorldModel pushes parts, and the whole map again every 2 s and when the part has moved",
          "[testing][world_model]") {
  try_component<Senses>({.type = "orca.WorldModel"}, [](Senses& robot) {
    robot.map.push(hall());
    robot.look(3.0, 2.0);
    robot.look(3.0, 2.0);
    (void)robot.take();
    int parts = 0, wholes = 0;
    for (int i = 0; i < 64; ++i) {  // 9.6 s
      robot.look(3.0, 2.0);
      for (const auto& grid : robot.take()) ++(is_whole(grid) ? wholes : parts);
    }
    CHECK(wholes == 4);
    CHECK(parts > 50);
    robot.look(9.0, 2.0);
    const auto after = robot.take();
    REQUIRE_FALSE(after.empty());
    CHECK(is_whole(after.front()));
  });
}

TEST_CASE("what was seen and lies outside of the part has the map's state again at who takes both",
          "[testing][world_model]") {
  try_component<Senses>({.type = "orca.WorldModel"}, [](Senses& robot) {
    robot.map.push(hall());
    for (int i = 0; i < 4; ++i) robot.look(3.0, 2.0);
    const auto seen = robot.take();
    const auto last_whole = std::ranges::find_if(seen, is_whole);
    REQUIRE(last_whole != seen.end());
    for (double x = 3.0; x < 25.0; x += 1.0) robot.look(x, 20.0);
    ObjectPtr<idl::OccupancyGrid> whole;
    for (const auto& grid : robot.take())
      if (is_whole(grid)) whole = grid;
    REQUIRE(whole);
    CHECK(whole->cells()[index_of(5.0, 3.0)] == 0);
  });
}

TEST_CASE("a WorldModel pushes nothing while no sensor is heard", "[testing][world_model]") {
  try_component<Senses>({.type = "orca.WorldModel"}, [](Senses& robot) {
    robot.map.push(hall());
    robot.look(3.0, 2.0);
    (void)robot.take();
    for (int i = 0; i < 100; ++i) robot.stand(3.0);
    CHECK(robot.take().empty());
  });
}

TEST_CASE("a map of more cells than can be searched is refused, and what is seen counts alone",
          "[testing][world_model]") {
  try_component<Senses>({.type = "orca.WorldModel"}, [](Senses& robot) {
    robot.map.push(hall(4096, 4096));
    robot.look(3.0, 2.0);
    robot.look(3.0, 2.0);
    const auto grids = robot.take();
    REQUIRE_FALSE(grids.empty());
    CHECK(grids.back()->name() == "seen");
  });
}

TEST_CASE("a WorldModel that takes another one's place knows what bumpers have touched",
          "[testing][world_model]") {
  try_component<Touching>({.type = "orca.WorldModel", .limit = 120s, .swap_at = 2s}, [](Touching& robot) {
    robot.map.push(hall());
    robot.look(3.0, 4.0);
    robot.touch();
    for (int i = 0; i < 4; ++i) robot.look(3.0, 4.0);
    CHECK(robot.last_at(3.23, 3.0) == 100);
    robot.sleep(3s);
    (void)robot.take();
    robot.look(3.0, 4.0);
    CHECK(robot.last_at(3.23, 3.0) == 100);
    CHECK(robot.last_at(3.5, 3.0) == 0);
    for (int i = 0; i < 1260; ++i) robot.stand(3.0);  // 63 s
    robot.look(3.0, 4.0);
    CHECK(robot.last_at(3.23, 3.0) == 0);  // forgotten
  });
}
