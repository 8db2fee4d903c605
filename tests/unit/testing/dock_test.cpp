// SPDX-License-Identifier: GPL-3.0-or-later
// A Dock among who gives goals, who drives, and a localizer that may not know where the robot is.
#include <catch2/catch.hpp>

#include <string>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

constexpr double kNoseAtWall = 4.75;  // [m] of a charger at x = 5 m

struct Charged final : Partner {
  using Partner::Partner;
  PushServer<idl::RobotPose> localizer{*this, "localizer"};
  PushServer<idl::Battery> battery{*this, "battery"};
  PushServer<idl::Arrived> arrived{*this, "arrived"};
  PushServer<idl::GoalFailed> failed{*this, "failed"};
  // Nobody takes what is in its queue while the script runs. So who drives takes one goal, and refuses the next.
  SendServer<idl::GoalPoint> goto_{*this, "goto", &Charged::on_goal, {.depth = 1}};
  SendProxy<idl::GoalPoint> goal{*this, "GotoCoordinateSend"};
  PushProxy<idl::Arrived> done{*this, "ArrivedPush"};
  PushProxy<idl::GoalFailed> undone{*this, "GoalFailedPush"};
  PushProxy<idl::MotionCommand> motion{*this, "motion"};
  PushProxy<idl::GoalPoint> touch{*this, "TouchPush"};

  bool knows = true;
  double x = 0.0;  // [m]

  Status on_goal(const ObjectPtr<idl::GoalPoint>& /*point*/) { return ok(); }

  // Returns whether the goal has been passed on: it was refused.
  [[nodiscard]] bool was_passed_on(const std::string& name) {
    if (!undone.new_data_arrived()) return false;
    const auto refused = undone.get_update();
    return refused->name() == name && refused->kind() == idl::GOAL_REFUSED;
  }

  void send(const std::string& name, double where) {
    auto there = make_object<idl::GoalPoint>();
    there->name(name);
    there->coordinate().point().x(where);
    there->use_orientation(true);
    there->reach_angle(0.1);
    REQUIRE(goal.send(std::move(there)).ok());
  }

  // Time passes, while the robot obeys.
  // @return the way that it was driven meanwhile [m].
  double live(double seconds, bool charges = false) {
    constexpr double kLap = 0.1;
    const double begin = x;
    for (double time = 0.0; time < seconds; time += kLap) {
      auto here = localizer.loan();
      here->x(x);
      here->stamp(to_time_value(now()));
      here->covariance(knows ? std::array<double, 9>{1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4} : anywhere());
      localizer.push(std::move(here));
      auto state = battery.loan();
      state->charging(charges);
      battery.push(std::move(state));
      sleep(from_seconds(kLap));
      const auto command = motion.latest();
      if (command && command->kind() == idl::MotionKind::NORMAL) x += kLap * command->speed();
      x = std::min(x, kNoseAtWall);
    }
    return x - begin;
  }

  // Drives to a charger at x = 5 m.
  void dock() {
    done.subscribe();
    undone.subscribe();
    motion.subscribe();
    touch.subscribe();
    x = 4.2;
    live(0.5);
    send("dock", 5.0);
    live(0.5);
    auto there = arrived.loan();
    there->name() = "before_dock";
    arrived.push(std::move(there));
    live(14.0);
    CHECK(x == kNoseAtWall);
    live(1.0, true);
    REQUIRE(done.new_data_arrived());
    CHECK(done.get_update()->name() == "dock");
  }
};

}  // namespace

TEST_CASE("a robot that is lost gets its goals, so that who drives says what becomes of them",
          "[testing][dock]") {
  try_component<Charged>({.type = "orca.Dock"}, [](Charged& robot) {
    robot.motion.subscribe();
    robot.undone.subscribe();
    robot.knows = false;
    robot.live(0.5);
    robot.send("kitchen", 3.0);
    robot.live(0.5);
    CHECK_FALSE(robot.undone.new_data_arrived());
    robot.send("library", 4.0);
    robot.live(0.5);
    CHECK(robot.was_passed_on("library"));
  });
}

TEST_CASE("a robot that is charged drives back before it goes elsewhere, and need not know where it is",
          "[testing][dock]") {
  for (const bool knows : {true, false})
    try_component<Charged>({.type = "orca.Dock"}, [&](Charged& robot) {
      robot.dock();
      robot.knows = knows;
      robot.live(30.0, true);
      CHECK(robot.x == kNoseAtWall);
      robot.send("kitchen", 3.0);
      CHECK(robot.live(7.0) < -0.3);
      CHECK_FALSE(robot.undone.new_data_arrived());
      const auto contacts = robot.touch.latest();
      REQUIRE(contacts);
      CHECK(std::abs(contacts->coordinate().point().x() - (5.0 - robot.x)) < 0.03);
      robot.live(2.0);
      CHECK(robot.x == Approx(kNoseAtWall - 0.4).margin(0.02));
      CHECK(robot.was_passed_on("kitchen"));
    });
}

TEST_CASE("a Dock that takes another one's place drives back from the charger, too", "[testing][dock]") {
  try_component<Charged>({.type = "orca.Dock", .swap_at = 20s}, [](Charged& robot) {
    robot.dock();
    robot.live(10.0);
    robot.send("kitchen", 3.0);
    robot.live(9.0);
    CHECK(robot.x == Approx(kNoseAtWall - 0.4).margin(0.02));
    CHECK(robot.was_passed_on("kitchen"));
  });
}

TEST_CASE("a robot that gets lost on its way to the contacts stands, and gives the goal up with the reason",
          "[testing][dock]") {
  try_component<Charged>({.type = "orca.Dock"}, [](Charged& robot) {
    robot.undone.subscribe();
    robot.motion.subscribe();
    robot.x = 4.2;
    robot.live(0.5);
    robot.send("dock", 5.0);
    robot.live(0.5);
    auto there = robot.arrived.loan();
    there->name() = "before_dock";
    robot.arrived.push(std::move(there));
    CHECK(robot.live(4.0) > 0.1);
    robot.knows = false;
    CHECK(std::abs(robot.live(9.0)) < 0.02);
    CHECK_FALSE(robot.undone.new_data_arrived());
    robot.live(3.0);
    REQUIRE(robot.undone.new_data_arrived());
    CHECK(robot.undone.get_update()->reason().starts_with("lost: "));
    CHECK(robot.motion.latest()->kind() == idl::MotionKind::DONTCARE);
  });
}
