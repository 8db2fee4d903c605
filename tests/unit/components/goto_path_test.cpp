// SPDX-License-Identifier: GPL-3.0-or-later
// The way that Goto shows to those who want to see it.
#include <catch2/catch.hpp>

#include <numbers>

#include "orca/goals/route.hpp"

using namespace orca;
using namespace orca::go;
using std::numbers::pi;

namespace {

Route::Point point(const char* name, double x, double y, bool via) {
  auto made = make_object<idl::GoalPoint>();
  made->name() = name;
  made->coordinate().point().x(x);
  made->coordinate().point().y(y);
  made->via(via);
  return std::move(made).seal();
}

void check_pose(const idl::Pose3D& pose, double x, double y, double yaw) {
  CHECK(pose.position().x() == x);
  CHECK(pose.position().y() == y);
  CHECK(pose.rotation().yaw() == Approx(yaw).margin(1e-12));
}

}  // namespace

TEST_CASE("a path begins at the robot, looks along the way and is named after its last point",
          "[goto][path]") {
  Route route;
  route.add(point("corner", 3.0, 1.0, true), TimePoint{});
  route.add(point("kitchen", 3.0, 5.0, false), TimePoint{});
  idl::Path path;
  path.poses().resize(7);  // Of an earlier use.
  fill_path(route, {1.0, 1.0, 0.3}, 0.1, path);
  CHECK(path.name() == "kitchen");
  REQUIRE(path.poses().size() == 3);
  check_pose(path.poses()[0], 1.0, 1.0, 0.3);
  CHECK(path.poses()[0].position().z() == 0.1);
  check_pose(path.poses()[1], 3.0, 1.0, 0.0);
  check_pose(path.poses()[2], 3.0, 5.0, pi / 2);
}

TEST_CASE("a path ends with the orientation that its goal asks for", "[goto][path]") {
  auto goal = copy_value(point("desk", 2.0, 0.0, false));
  goal->use_orientation(true);
  goal->orientation().orientation().yaw(pi);
  Route route;
  route.add(std::move(goal), TimePoint{});
  idl::Path path;
  fill_path(route, {}, 0.0, path);
  check_pose(path.poses().back(), 2.0, 0.0, pi);
}

TEST_CASE("without a route there is no path", "[goto][path]") {
  idl::Path path;
  path.name() = "kitchen";
  path.poses().resize(2);
  fill_path(Route(), {}, 0.0, path);
  CHECK(path.poses().empty());
  CHECK(path.name().empty());
}

TEST_CASE("a route counts its changes", "[goto][path]") {
  Route route;
  const std::uint64_t before = route.changes();
  route.add(point("kitchen", 1.0, 0.0, false), TimePoint{});
  const std::uint64_t added = route.changes();
  CHECK(added != before);
  route.pop();
  CHECK(route.changes() != added);
}
