// SPDX-License-Identifier: GPL-3.0-or-later
// Where robots are and to which places they drive, from the objects that are delivered.
#include "run/reporting/sightings.hpp"

#include <catch2/catch.hpp>

#include <utility>

#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"

using namespace orca;
using namespace orca::host;

namespace {

template <class T>
ObjectRef posed(const std::string& origin, std::uint64_t seq, double x, double y) {
  auto made = make_object<T>();
  made->origin() = origin;
  made->seq(seq);
  made->x(x);
  made->y(y);
  return ObjectLoan(std::move(made)).seal();
}

ObjectRef goal(const std::string& origin, const std::string& name, double x, double y) {
  auto made = make_object<idl::GoalPoint>();
  made->origin() = origin;
  made->name() = name;
  made->coordinate().point().x(x);
  made->coordinate().point().y(y);
  return ObjectLoan(std::move(made)).seal();
}

}  // namespace

TEST_CASE("the distance to a goal is that from the last pose which its component has received",
          "[host][sightings]") {
  Sightings sightings;
  CHECK(sightings.goals().empty());
  sightings.delivered("avoid", goal("goto", "kitchen", 3.0, 4.0));
  CHECK(sightings.goals().empty());  // nobody has told where the robot is
  sightings.delivered("other", posed<idl::RobotPose>("localizer", 1, 9.0, 9.0));
  CHECK(sightings.goals().empty());
  sightings.delivered("goto", posed<idl::RobotPose>("localizer", 1, 0.0, 0.0));
  REQUIRE(sightings.goals().size() == 1);
  CHECK(sightings.goals()[0].name == "kitchen");
  CHECK(sightings.goals()[0].distance == Approx(5.0));
  sightings.delivered("avoid", goal("goto", "lab", 1.0, 0.0));
  CHECK(sightings.goals()[0].name == "lab");
  CHECK(sightings.goals()[0].distance == Approx(1.0));
}

TEST_CASE("a localizer's pose counts before that of the odometry", "[host][sightings]") {
  Sightings sightings;
  sightings.delivered("avoid", goal("goto", "kitchen", 10.0, 0.0));
  sightings.delivered("goto", posed<idl::Odometry>("base", 1, 1.0, 0.0));
  CHECK(sightings.goals().at(0).distance == Approx(9.0));
  sightings.delivered("goto", posed<idl::RobotPose>("localizer", 1, 4.0, 0.0));
  sightings.delivered("goto", posed<idl::Odometry>("base", 2, 2.0, 0.0));
  CHECK(sightings.goals().at(0).distance == Approx(6.0));
}

TEST_CASE("the way is the sum of the steps, each counted once however many receive it", "[host][sightings]") {
  Sightings sightings;
  for (const char* receiver : {"avoid", "goto"}) {
    sightings.delivered(receiver, posed<idl::Odometry>("base", 1, 5.0, 5.0));
    sightings.delivered(receiver, posed<idl::Odometry>("base", 2, 5.0, 6.0));
    sightings.delivered(receiver, posed<idl::Odometry>("base", 3, 5.0, 5.5));
  }
  REQUIRE(sightings.ways().size() == 1);
  CHECK(sightings.ways()[0].robot == "base");
  CHECK(sightings.ways()[0].length == Approx(1.5));
}

TEST_CASE("poses tell the way only where nobody listens to any odometry", "[host][sightings]") {
  Sightings sightings;
  sightings.delivered("goto", posed<idl::RobotPose>("localizer", 1, 0.0, 0.0));
  sightings.delivered("goto", posed<idl::RobotPose>("localizer", 2, 2.0, 0.0));
  CHECK(sightings.ways().at(0).robot == "localizer");
  CHECK(sightings.ways().at(0).length == Approx(2.0));
  sightings.delivered("goto", posed<idl::Odometry>("base", 1, 0.0, 0.0));
  REQUIRE(sightings.ways().size() == 1);
  CHECK(sightings.ways()[0].robot == "base");
}
