// SPDX-License-Identifier: GPL-3.0-or-later
// The map that a SlamLocalizer makes, as its clients have it.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/testing/component_trial.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::testing;

namespace {

constexpr int kNotKnown = 255;
constexpr double kRange = 8.0;                                // [m] of the laser
constexpr std::array<double, 4> kRoom{-6.0, -2.0, 6.0, 3.0};  // least x and y, largest x and y

struct Mapper final : Partner {
  using Partner::Partner;
  PushServer<idl::RobotPose> drifting{*this, "drifting"};
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushProxy<idl::RobotPose> pose{*this, "RobotPosePush"};
  QueryProxy<idl::Ask, idl::OccupancyGrid> asked{*this, "OccupancyGridQuery"};
  QueryProxy<idl::Ask, idl::Path> way{*this, "PathQuery"};
  PushProxy<idl::OccupancyGrid> pushed{*this, "OccupancyGridPush", {.manual = true}};

  Pose2 X_DM;                // the map's frame in that of the drifting pose
  bool has_pillars = false;  // Without them the room looks the same along its walls.

  /// Sends the pose and what a laser in the middle of the robot sees of the room.
  void stand(double x, double y) {
    auto scan = laser.loan();
    scan->stamp().ns(now().time_since_epoch().count());
    scan->min_range(0.1);
    scan->max_range(kRange);
    scan->angle_start(-0.5 * std::numbers::pi);
    scan->angle_increment(std::numbers::pi / 180.0);
    for (int i = 0; i <= 180; ++i)
      scan->ranges().push_back(range(x, y, scan->angle_start() + i * scan->angle_increment()));
    auto here = drifting.loan();
    const Pose2 X_DR = X_DM * Pose2{x, y, 0.0};
    here->x(X_DR.x);
    here->y(X_DR.y);
    here->orientation(X_DR.yaw);
    here->stamp().ns(now().time_since_epoch().count());
    here->covariance({1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4});
    laser.push(std::move(scan));
    drifting.push(std::move(here));
    (void)pose.get_update_wait();
    sleep(std::chrono::milliseconds(100));
  }

  /// Sends a pose that says that the robot may be anywhere.
  void lose() {
    auto somewhere = drifting.loan();
    somewhere->stamp().ns(now().time_since_epoch().count());
    somewhere->covariance(anywhere());
    drifting.push(std::move(somewhere));
    (void)pose.get_update_wait();
  }

  void drive(double from, double to) {
    for (double x = from; x < to; x += 0.1) stand(x, 0.5);
  }

  ObjectPtr<idl::OccupancyGrid> whole() { return asked.query(asked.loan()).value(); }

 private:
  using Box = std::array<double, 4>;  // least x and y, largest x and y

  // How far a ray goes from a place in the room.
  [[nodiscard]] double range(double x, double y, double angle) const {
    const double ahead = std::cos(angle), left = std::sin(angle);
    double nearest = std::min(within({x, y}, {ahead, left}, kRoom).second, kRange);
    for (const Box& pillar :
         {Box{-3.5, -2.0, -3.2, -1.5}, {-1.4, -2.0, -0.9, -1.4}, {2.2, -2.0, 2.4, -1.3}}) {
      const auto [in, out] = within({x, y}, {ahead, left}, pillar);
      if (has_pillars && in > 0.0 && in < out) nearest = std::min(nearest, in);
    }
    return nearest;
  }

  // Where a line goes into a box, and where it comes out: in units of `by`.
  static std::pair<double, double> within(const Vec2& from, const Vec2& by, const Box& box) {
    double in = -std::numeric_limits<double>::infinity();
    double out = std::numeric_limits<double>::infinity();
    const auto cut = [&](double distance_to_low, double distance_to_high, double speed) {
      if (std::fabs(speed) < 1e-9) return;  // No wall of the room is hit along another one.
      in = std::max(in, std::min(distance_to_low / speed, distance_to_high / speed));
      out = std::min(out, std::max(distance_to_low / speed, distance_to_high / speed));
    };
    cut(box[0] - from.x, box[2] - from.x, by.x);
    cut(box[1] - from.y, box[3] - from.y, by.y);
    return {in, out};
  }
};

int value_at(const idl::OccupancyGrid& map, double x, double y) {
  const double column = std::floor((x - map.corner().x()) / map.resolution());
  const double row = std::floor((y - map.corner().y()) / map.resolution());
  if (column < 0 || row < 0 || column >= map.columns() || row >= map.rows()) return kNotKnown;
  return map.cells().at(static_cast<std::size_t>(row) * map.columns() + static_cast<std::size_t>(column));
}

// A client's map, of all that it was pushed.
struct Pasted {
  idl::OccupancyGrid all;

  Pasted() {
    all.corner().x(-20.0);
    all.corner().y(-20.0);
    all.resolution(0.05);
    all.columns(800);
    all.rows(800);
    all.cells().assign(std::size_t{800} * 800, kNotKnown);
  }
  void paste(const idl::OccupancyGrid& part) {
    for (std::size_t i = 0; i < part.cells().size(); ++i) {
      const double x = part.corner().x() + (static_cast<double>(i % part.columns()) + 0.5) * 0.05;
      const double y = part.corner().y() + (static_cast<double>(i / part.columns()) + 0.5) * 0.05;
      const auto column = static_cast<std::size_t>((x + 20.0) / 0.05);
      const auto row = static_cast<std::size_t>((y + 20.0) / 0.05);
      all.cells().at(row * 800 + column) = part.cells()[i];
    }
  }
};

}  // namespace

TEST_CASE("a SlamLocalizer answers with the map that it has made", "[testing][slam]") {
  ObjectPtr<idl::OccupancyGrid> map;
  try_component<Mapper>({.type = "orca.SlamLocalizer"}, [&](Mapper& robot) {
    robot.drive(-5.0, 3.0);
    map = robot.whole();
  });
  CHECK_THAT(map->name(), Catch::StartsWith("slam "));
  CHECK(map->resolution() == 0.05);
  CHECK(value_at(*map, 0.02, 0.52) == 0);                    // on the way
  CHECK(value_at(*map, 0.02, kRoom[3] + 0.3) == kNotKnown);  // behind a wall
  const auto wall = [&](double x) {
    return std::max(value_at(*map, x, kRoom[3] - 0.02), value_at(*map, x, kRoom[3] + 0.02));
  };
  for (double x = -4.0; x < 5.0; x += 0.25) CHECK(wall(x) == 100);
}

TEST_CASE("a SlamLocalizer that has seen nothing says so instead of a map of nothing", "[testing][slam]") {
  std::string before, after;
  try_component<Mapper>({.type = "orca.SlamLocalizer"}, [&](Mapper& robot) {
    before = robot.asked.query(robot.asked.loan()).error().text();
    robot.drive(-5.0, -4.0);
    robot.lose();
    after = robot.asked.query(robot.asked.loan()).error().text();
  });
  CHECK_THAT(before, Catch::Contains("there is no map yet: no scan has come at laser"));
  CHECK_THAT(after, Catch::Contains("there is no map: the drifting pose is not known"));
}

TEST_CASE("what a SlamLocalizer pushes are changes, which together make its map", "[testing][slam]") {
  Pasted client;
  std::vector<std::size_t> sizes;
  std::set<std::string> names;
  ObjectPtr<idl::OccupancyGrid> map;
  int after = 0;
  try_component<Mapper>({.type = "orca.SlamLocalizer"}, [&](Mapper& robot) {
    const auto take = [&] {
      for (; robot.pushed.new_data_arrived(); ++after) {
        const auto part = robot.pushed.get_update();
        names.insert(part->name());
        client.paste(*part);
        sizes.push_back(part->cells().size());
      }
    };
    robot.drive(-5.0, -3.0);
    robot.pushed.subscribe();
    for (double x = -3.0; x < 3.0; x += 0.5) {
      robot.drive(x, x + 0.5);
      (void)robot.whole();  // Others who ask take nothing away.
      take();
    }
    for (int i = 0; i < 20; ++i) robot.stand(3.0, 0.5);
    take();
    after = 0;
    for (int i = 0; i < 50; ++i) robot.stand(3.0, 0.5);
    take();
    map = robot.whole();
  });
  CHECK(names == std::set<std::string>{map->name()});
  REQUIRE(sizes.size() > 3);
  CHECK(sizes.size() < 10);  // At most once a second of the 8 s.
  CHECK(after == 0);         // Nothing changes where it stands.
  int different = 0;
  for (double x = -6.975; x < 7.0; x += 0.05)
    for (double y = -2.975; y < 4.0; y += 0.05)
      different += value_at(client.all, x, y) != value_at(*map, x, y) ? 1 : 0;
  CHECK(different == 0);
}

TEST_CASE("a SlamLocalizer pushes the whole map to a client that comes as another leaves",
          "[testing][slam]") {
  ObjectPtr<idl::OccupancyGrid> map, first;
  try_component<Mapper>({.type = "orca.SlamLocalizer"}, [&](Mapper& robot) {
    robot.pushed.subscribe();
    robot.drive(-5.0, 3.0);
    robot.pushed.unsubscribe();
    robot.pushed.subscribe();  // within one lap: there is one subscriber, as before
    for (int i = 0; i < 20; ++i) robot.stand(3.0, 0.5);
    if (robot.pushed.new_data_arrived()) first = robot.pushed.get_update();
    map = robot.whole();
  });
  REQUIRE(first);
  CHECK(first->cells().size() == map->cells().size());
}

TEST_CASE("a SlamLocalizer that was set to another place has a map of another name there",
          "[testing][slam]") {
  ObjectPtr<idl::OccupancyGrid> before, map;
  try_component<Mapper>({.type = "orca.SlamLocalizer"}, [&](Mapper& robot) {
    robot.drive(-5.0, -4.0);
    before = robot.whole();
    for (int i = 0; i < 5; ++i) robot.stand(4.0, 0.5);
    map = robot.whole();
  });
  CHECK(map->name() != before->name());
  CHECK(value_at(*map, -4.5, 0.52) == kNotKnown);
}

namespace {

// The session of a day.
Trial day(const std::string& file) { return {.type = "orca.SlamLocalizer", .params = {{"session", file}}}; }

// Whether it claims to be there.
bool is_at(const Mapper& robot, const Vec2& place) {
  const auto pose = robot.pose.latest();
  UNSCOPED_INFO(pose->x() << ' ' << pose->y() << ' ' << pose->covariance()[0]);
  return !is_anywhere(pose->covariance()) && norm(plane_pose(*pose).position() - place) < 0.1;
}

}  // namespace

TEST_CASE("a SlamLocalizer goes on with the map of the day before, and keeps what both have seen",
          "[testing][slam]") {
  const test::TempFolder folder;
  const std::string file = folder.file("room.session");
  try_component<Mapper>(day(file), [&](Mapper& robot) {
    robot.has_pillars = true;
    robot.drive(-5.0, -3.0);
  });
  REQUIRE(std::filesystem::exists(file));
  ObjectPtr<idl::OccupancyGrid> map;
  std::optional<ObjectPtr<idl::Path>> way;
  try_component<Mapper>(day(file), [&](Mapper& robot) {
    robot.has_pillars = true;
    robot.X_DM = {10.0, 2.0, 1.0};  // Odometry counts from another place today.
    robot.drive(-3.0, 3.0);
    CHECK(is_at(robot, {2.9, 0.5}));
    map = robot.whole();
    way = robot.way.query(robot.way.loan()).value();
  });
  const auto wall = [&](double x) {
    int most = 0;
    for (double y = kRoom[3] - 0.1; y < kRoom[3] + 0.1; y += 0.02)
      if (value_at(*map, x, y) != kNotKnown) most = std::max(most, value_at(*map, x, y));
    return most;
  };
  CHECK(wall(-4.5) == 100);  // beside the robot, before the second day
  CHECK(wall(2.0) == 100);
  int ahead = 0;  // out of sight on the first day
  for (double x = kRoom[2] - 0.1; x < kRoom[2] + 0.1; x += 0.02)
    ahead += value_at(*map, x, 0.52) == 100 ? 1 : 0;
  CHECK(ahead > 0);
  // The way is that of this run.
  REQUIRE((*way)->poses().size() > 10);
  CHECK((*way)->poses().front().position().x() > -3.0);
  CHECK(std::filesystem::exists(file + ".old"));
}

TEST_CASE("a SlamLocalizer that was set to another place finds itself in the map of its session",
          "[testing][slam]") {
  const test::TempFolder folder;
  try_component<Mapper>(day(folder.file("room.session")), [&](Mapper& robot) {
    robot.has_pillars = true;
    robot.drive(-2.0, 3.0);
    const std::string name = robot.whole()->name();
    robot.lose();
    CHECK(is_anywhere(robot.pose.latest()->covariance()));
    robot.X_DM = {10.0, 2.0, 1.0};
    for (int i = 0; i < 30; ++i) robot.stand(2.0, 1.5);
    CHECK(robot.whole()->name() == name);
    CHECK(is_at(robot, {2.0, 1.5}));
  });
}

TEST_CASE("a SlamLocalizer that is exchanged finds itself in the map of its session", "[testing][slam]") {
  const test::TempFolder folder;
  Trial exchanged = day(folder.file("room.session"));
  for (const Duration swap_at : {Duration{0}, Duration{std::chrono::seconds(2)}}) {
    exchanged.swap_at = swap_at;
    try_component<Mapper>(exchanged, [&](Mapper& robot) {
      robot.has_pillars = true;
      robot.drive(-5.0, 0.0);
      CHECK(is_at(robot, {-0.1, 0.5}));
    });
  }
}

TEST_CASE("a SlamLocalizer refuses a session that is damaged, with what to do", "[testing][slam]") {
  const test::TempFolder folder;
  const std::string file = folder.file("room.session");
  try_component<Mapper>(day(file), [&](Mapper& robot) { robot.drive(-5.0, -4.0); });
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  CHECK_THROWS_WITH(try_component<Mapper>(day(file), [](Mapper& robot) { robot.stand(0.0, 0.5); }),
                    Catch::Contains("this file is damaged") &&
                        Catch::Contains("put an older copy in its place (" + file + ".old is the last one)"));
  CHECK_THROWS_WITH(
      try_component<Mapper>(day(folder.file("none/room")), [](Mapper& robot) { robot.stand(0.0, 0.5); }),
      Catch::Contains("cannot be written: its folder: No such file or directory"));
}
