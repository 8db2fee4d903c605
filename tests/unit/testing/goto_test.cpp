// SPDX-License-Identifier: GPL-3.0-or-later
// What Goto says of goals where it cannot be sure to have arrived.
#include <catch2/catch.hpp>

#include <numbers>
#include <string>

#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

struct Client final : Partner {
  using Partner::Partner;
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushProxy<idl::GoalFailed> failed{*this, "GoalFailedPush"};
  SendProxy<idl::GoalPoint> goal{*this, "GotoCoordinateSend"};

  void tell(double x, double covariance) {
    auto here = odometry.loan();
    here->x(x);
    here->stamp(to_time_value(now()));
    if (covariance > 0.0) here->covariance({covariance, 0, 0, 0, covariance, 0, 0, 0, covariance});
    odometry.push(std::move(here));
    sleep(100ms);
  }
};

// Returns why a goal 20 m ahead with a reach of 5 mm is given up by a robot that has driven there. Each odometry has that variance [m2],
// or none.
std::string reason_at_goal(double covariance) {
  std::string reason;
  try_component<Client>({.type = "orca.Goto", .params = {{"blocked_after", "3 s"}}}, [&](Client& client) {
    client.failed.subscribe();
    client.tell(0.0, covariance);
    auto there = make_object<idl::GoalPoint>();
    there->name("far");
    there->coordinate().point().x(20.0);
    there->reach_radius().distance(0.005);
    REQUIRE(client.goal.send(std::move(there)).ok());
    for (int i = 1; i <= 40; ++i) client.tell(0.5 * i, covariance);
    for (int i = 0; i < 100 && !client.failed.new_data_arrived(); ++i) client.tell(20.0, covariance);
    REQUIRE(client.failed.new_data_arrived());
    reason = client.failed.get_update()->reason();
  });
  return reason;
}

struct Driver final : Partner {
  using Partner::Partner;
  PushServer<idl::RobotPose> localizer{*this, "localizer"};
  PushProxy<idl::GoalPoint> place{*this, "GoalPush", {.depth = 16}};
  SendProxy<idl::GoalPoint> goal{*this, "GotoCoordinateSend"};

  // Stands at x = 2 m, and returns the y of the place to which the robot drives then [m].
  double place_from(double y) {
    auto here = localizer.loan();
    here->x(2.0);
    here->y(y);
    here->stamp(to_time_value(now()));
    localizer.push(std::move(here));
    sleep(100ms);
    double to = 0.0;
    while (place.new_data_arrived()) to = place.get_update()->coordinate().point().y();
    return to;
  }
};

// Returns a door at (2 m, 4.5 m) that leads north.
Loan<idl::GoalPoint> door() {
  auto made = make_object<idl::Door>();
  made->name("door");
  made->coordinate().point().x(2.0);
  made->coordinate().point().y(4.5);
  made->orientation().orientation().yaw(std::numbers::pi / 2.0);
  made->reach_radius().distance(0.3);
  made->via(true);
  made->passable(true);
  return made;
}

}  // namespace

TEST_CASE("a Goto that takes another one's place in a doorway drives on to the side where that drove",
          "[testing][goto]") {
  try_component<Driver>({.type = "orca.Goto", .swap_at = 1s}, [](Driver& robot) {
    robot.place.subscribe();
    CHECK(robot.place_from(3.0) == 0.0);
    REQUIRE(robot.goal.send(door()).ok());
    CHECK(robot.place_from(3.0) == Approx(3.8));
    CHECK(robot.place_from(3.8) == Approx(5.2));
    CHECK(robot.place_from(4.6) == Approx(5.2));  // beyond its middle
    robot.sleep(1500ms);
    CHECK(robot.place_from(4.6) == Approx(5.2));
  });
}

TEST_CASE("a goal that is not reached for sure is given up with what is known of the place",
          "[testing][goto]") {
  const std::string told = reason_at_goal(0.01);
  CHECK_THAT(told, Contains("blocked: ") && Contains("its position is known only to 0.1 m"));
  CHECK_THAT(told, !Contains("guess"));
}

TEST_CASE("that odometry does not say how wrong it is is said where it counts", "[testing][goto]") {
  CHECK_THAT(reason_at_goal(0.0),
             Contains("its position is known only to") &&
                 Contains("this is a guess, as its odometry does not say how wrong it is"));
}
