// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/component/state.hpp"
#include "porter/errand.hpp"

using namespace orca;
using namespace orca::porter;
using Catch::Contains;

namespace {

constexpr Manner kManner{
    .reach = 0.32, .approach_speed = 0.1, .turn_rate = 0.5, .back_off = 0.3, .patience = 20.0};
constexpr double kLap = 0.05;  // [s]

/// A robot on an empty floor with a gripper, which does at once what it is told. A thing may stand there.
struct Floor {
  Pose2 pose{};
  std::optional<Vec2> thing{};  // [m] where it stands, unless it is held
  idl::GripperState gripper{};
  bool deaf = false;      // the gripper does not do what it is told
  bool slippery = false;  // it loses what it holds on the way
  int told = 0;           // commands
  double time = 0.0;

  Floor() { gripper.closed(true), gripper.up(true); }

  void drive(const Wish& wish) {
    const double turn_rate = wish.speed != 0.0 ? wish.direction : wish.turn_rate;
    pose.yaw = wrapped(pose.yaw + kLap * turn_rate);
    pose.x += kLap * wish.speed * portable::cos(pose.yaw);
    pose.y += kLap * wish.speed * portable::sin(pose.yaw);
    time += kLap;
  }

  void obey(const idl::GripperCommand& command) {
    ++told;
    if (deaf) return;
    if (command.lift() != idl::LIFT_STAY) {
      gripper.up(command.lift() == idl::LIFT_UP);
      gripper.down(!gripper.up());
    }
    if (command.paddles() == idl::PADDLES_OPEN) {
      if (gripper.holds()) thing = at_paddles();
      gripper.open(true), gripper.closed(false), gripper.holds(false);
    }
    if (command.paddles() == idl::PADDLES_CLOSE) {
      gripper.open(false), gripper.holds(is_between()), gripper.closed(!gripper.holds());
      if (gripper.holds()) thing.reset();
    }
  }

  void feel() {
    gripper.inner_beam(gripper.holds() || is_between());
    if (slippery && pose.x > 0.1 && gripper.holds()) gripper.holds(false), gripper.closed(true);
  }

  [[nodiscard]] Vec2 at_paddles() const { return pose.position() + kManner.reach * direction(pose.yaw); }
  [[nodiscard]] bool is_between() const {
    return thing && portable::hypot(thing->x - at_paddles().x, thing->y - at_paddles().y) < 0.05;
  }

  /// Does a lap of an errand.
  Step lap(Errand& errand) {
    feel();
    const Step step = errand.step(pose, gripper, time, kManner);
    if (step.kind != Step::Kind::goes_on) return step;
    if (step.gripper) obey(*step.gripper);
    drive(step.wish);
    return step;
  }

  /// Does an errand until it ends. @return  its last step.
  Step run(Errand errand) {
    Step step;
    for (int laps = 0; laps < 4000 && step.kind == Step::Kind::goes_on; ++laps) step = lap(errand);
    return step;
  }
};

}  // namespace

TEST_CASE("what stands at the place is between the lifted paddles afterwards", "[components][errand]") {
  Floor floor;
  floor.pose = {0.0, 0.0, 2.0};  // it looks elsewhere
  floor.thing = Vec2{0.7, 0.02};
  const Step last = floor.run({Errand::Kind::fetch, {0.7, 0.0}});
  CHECK(last.kind == Step::Kind::done);
  CHECK(floor.gripper.holds());
  CHECK(floor.gripper.up());
  CHECK_FALSE(floor.thing);
}

TEST_CASE("a robot whose motors are held for minutes before the thing fetches it afterwards",
          "[components][errand]") {
  Floor floor;
  floor.thing = Vec2{0.7, 0.0};
  Errand errand{Errand::Kind::fetch, {0.7, 0.0}};
  while (floor.pose.x < 0.1) REQUIRE(floor.lap(errand).kind == Step::Kind::goes_on);
  for (const double begin = floor.time; floor.time < begin + 300.0; floor.time += kLap) {
    errand.delay(kLap);
    REQUIRE(errand.step(floor.pose, floor.gripper, floor.time, kManner).kind == Step::Kind::goes_on);
  }
  CHECK(floor.run(errand).kind == Step::Kind::done);
}

TEST_CASE("what it holds stands at the place afterwards, and the robot has driven back from it",
          "[components][errand]") {
  Floor floor;
  floor.gripper.holds(true), floor.gripper.closed(false);
  const Step last = floor.run({Errand::Kind::put, {0.5, 0.5}});
  REQUIRE(last.kind == Step::Kind::done);
  REQUIRE(floor.thing);
  CHECK(floor.thing->x == Approx(0.5).margin(0.02));
  CHECK(floor.thing->y == Approx(0.5).margin(0.02));
  CHECK(portable::hypot(0.5 - floor.pose.x, 0.5 - floor.pose.y) == Approx(0.62).margin(0.02));
  CHECK(floor.gripper.down());
}

TEST_CASE("nothing at the place is a failure, and the robot stops short of it", "[components][errand]") {
  Floor floor;
  const Step last = floor.run({Errand::Kind::fetch, {0.7, 0.0}});
  CHECK(last.kind == Step::Kind::failed);
  CHECK_THAT(last.reason, Contains("nothing came between the paddles"));
  CHECK(floor.pose.x < 0.5);
}

TEST_CASE("paddles that close on nothing are a failure", "[components][errand]") {
  Floor floor;
  floor.thing = Vec2{0.7, 0.0};
  Errand errand(Errand::Kind::fetch, {0.7, 0.0});
  Step step;
  for (int lap = 0; lap < 4000 && step.kind == Step::Kind::goes_on; ++lap) {
    floor.feel();
    step = errand.step(floor.pose, floor.gripper, floor.time, kManner);
    if (step.gripper && step.gripper->paddles() == idl::PADDLES_CLOSE)
      floor.thing.reset();  // somebody takes it
    if (step.gripper) floor.obey(*step.gripper);
    floor.drive(step.wish);
  }
  CHECK(step.kind == Step::Kind::failed);
  CHECK_THAT(step.reason, Contains("closed on nothing"));
}

TEST_CASE("without anything to put down it fails at once", "[components][errand]") {
  Floor floor;
  const Step last = floor.run({Errand::Kind::put, {0.7, 0.0}});
  CHECK(last.kind == Step::Kind::failed);
  CHECK_THAT(last.reason, Contains("nothing between the paddles"));
  CHECK(floor.pose.x == 0.0);
}

TEST_CASE("what is lost on the last bit of the way is not put down", "[components][errand]") {
  Floor floor;
  floor.gripper.holds(true), floor.gripper.closed(false);
  floor.slippery = true;
  const Step last = floor.run({Errand::Kind::put, {0.7, 0.0}});
  CHECK(last.kind == Step::Kind::failed);
  CHECK_THAT(last.reason, Contains("has lost"));
}

TEST_CASE("a gripper that does not move is told again each second, and given up after a while",
          "[components][errand]") {
  Floor floor;
  floor.deaf = true;
  const Step last = floor.run({Errand::Kind::fetch, {0.7, 0.0}});
  CHECK(last.kind == Step::Kind::failed);
  CHECK_THAT(last.reason, Contains("does not open"));
  CHECK(floor.told == Approx(20).margin(1));
  CHECK(floor.time == Approx(kManner.patience).margin(0.2));
}

TEST_CASE("after an exchange of the code an errand goes on where it was", "[components][errand]") {
  Floor floor;
  floor.thing = Vec2{0.7, 0.0};
  Errand first(Errand::Kind::fetch, {0.7, 0.0});
  while (floor.pose.x < 0.2 && floor.time < 60.0) REQUIRE(floor.lap(first).kind == Step::Kind::goes_on);
  CHECK(floor.told == 1);  // to open and go down
  StateWriter saved;
  saved.write(first);
  Errand second;
  StateReader state({"orca.Porter", 1}, saved.bytes());
  REQUIRE(state.read(second).ok());
  CHECK(floor.run(second).kind == Step::Kind::done);
  CHECK(floor.gripper.holds());
  CHECK(floor.told == 3);  // to close, and to lift
}
