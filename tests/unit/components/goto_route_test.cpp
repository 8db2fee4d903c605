// SPDX-License-Identifier: GPL-3.0-or-later
// The points that Goto drives to, and how long it tries.
#include <catch2/catch.hpp>

#include <string>

#include "orca/goals/patience.hpp"
#include "orca/goals/route.hpp"

using namespace orca;
using namespace orca::go;
using namespace std::chrono_literals;

namespace {

constexpr TimePoint kStart{1000s};

Route::Point point(const std::string& name, std::uint64_t mission, bool via = false) {
  auto made = make_object<idl::GoalPoint>();
  made->name() = name;
  made->mission(mission);
  made->via(via);
  return std::move(made).seal();
}

Route::Point via(const std::string& name, std::uint64_t mission) { return point(name, mission, true); }

// Adds the points, one after the other, and returns the names on the route.
std::string names_after(Route& route, const std::vector<Route::Point>& points) {
  for (const Route::Point& point : points) route.add(point, kStart);
  std::string names;
  for (; !route.empty(); route.pop()) names += (names.empty() ? "" : " ") + route.next().name();
  return names;
}

}  // namespace

TEST_CASE("via points come before the goal that follows them", "[components][goto]") {
  Route route;
  CHECK(names_after(route, {via("a", 1), via("b", 1), point("c", 1)}) == "a b c");
}

TEST_CASE("what comes after a goal replaces the route, and so does what belongs to another mission",
          "[components][goto]") {
  Route route;
  CHECK(names_after(route, {via("a", 0), point("b", 0), point("c", 0)}) == "c");
  CHECK(names_after(route, {via("a", 1), via("b", 1), via("c", 2), point("d", 2)}) == "c d");
}

TEST_CASE("a route that is given up is empty, and the rest of its mission is not wanted",
          "[components][goto]") {
  Route route;
  route.add(via("a", 1), kStart);
  route.give_up(1);
  CHECK(route.empty());
  CHECK(route.is_given_up(*point("b", 1)));
  CHECK_FALSE(route.is_given_up(*point("b", 2)));
}

TEST_CASE("giving up one mission leaves the route of another, and points without mission may come again",
          "[components][goto]") {
  Route route;
  route.add(point("a", 1), kStart);
  route.give_up(2);
  CHECK_FALSE(route.empty());
  route.give_up(0);
  CHECK_FALSE(route.is_given_up(*point("b", 0)));
}

TEST_CASE("the age of a route counts from its first point", "[components][goto]") {
  Route route;
  route.add(via("a", 1), kStart);
  route.add(point("b", 1), kStart + 1s);
  CHECK(route.age(kStart + 3s) == 3.0);
  route.add(point("c", 2), kStart + 4s);
  CHECK(route.age(kStart + 5s) == 1.0);
}

TEST_CASE("patience wears out while the robot comes no nearer than it has been", "[components][goto]") {
  Patience patience;
  CHECK(patience.note(5.0, kStart) == 0.0);
  CHECK(patience.note(4.0, kStart + 1s) == 0.0);
  CHECK(patience.note(6.0, kStart + 3s) == 2.0);   // it drives round something
  CHECK(patience.note(3.95, kStart + 4s) == 3.0);  // not noticeably nearer
  CHECK(patience.nearest() == 4.0);
  CHECK(patience.note(3.8, kStart + 5s) == 0.0);
  patience.begin();
  CHECK(patience.note(9.0, kStart + 9s) == 0.0);
}
