// SPDX-License-Identifier: GPL-3.0-or-later
// Whom a FollowPerson follows, by what it is told.
#include <catch2/catch.hpp>

#include "orca/idl/motion.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

// A robot that stands in the open, with somebody before it.
struct Follower final : Partner {
  using Partner::Partner;
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushServer<idl::MovingThings> moving{*this, "moving"};
  PushProxy<idl::MotionCommand> motion{*this, "MotionCmdPush"};

  Duration ahead{};  // of the stamps of those who move

  void live() {
    auto there = moving.loan();
    there->stamp(to_time_value(now() + ahead));
    idl::MovingThing person;
    person.number(1);
    person.x(2.0);
    person.radius(0.3);
    there->things().push_back(person);
    moving.push(std::move(there));
    auto here = odometry.loan();
    here->stamp(to_time_value(now()));
    odometry.push(std::move(here));
    sleep(100ms);
  }

  // Returns the speed that it wants after a second [m/s].
  double follow() {
    motion.subscribe();
    for (int lap = 0; lap < 10; ++lap) live();
    return motion.latest()->speed();
  }
};

}  // namespace

TEST_CASE("whoever was seen tomorrow is followed by nobody", "[testing][follow]") {
  try_component<Follower>({.type = "orca.FollowPerson"}, [](Follower& robot) {
    robot.ahead = 24h;
    CHECK(robot.follow() == 0.0);
    robot.ahead = 0h;
    CHECK(robot.follow() > 0.2);
  });
}
