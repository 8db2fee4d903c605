// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "orca/idl/geometry.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

using orca::ObjectPtr;
using orca::idl::MotionCommand;

TEST_CASE("full_stop stops and dont_care weighs nothing", "[idl][motion]") {
  const ObjectPtr<MotionCommand> stop = orca::full_stop();
  CHECK(stop->kind() == orca::idl::FULLSTOP);
  CHECK(stop->speed() == 0.0);
  const ObjectPtr<MotionCommand> idle = orca::dont_care();
  CHECK(idle->kind() == orca::idl::DONTCARE);
  CHECK(idle->weight() == 0.0);
}

TEST_CASE("a command with a number that is not finite, or with a negative weight, is no command",
          "[idl][motion]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(orca::check_command(*orca::head(0.5, 0.3)).ok());
  CHECK(orca::check_command(*orca::dont_care()).ok());
  for (const auto& wrong : {orca::head(nan, 0.3), orca::head(0.5, nan), orca::turn(INFINITY, 0.3),
                            orca::head(0.5, 0.3, nan), orca::head(0.5, 0.3, -1.0)})
    CHECK(orca::check_command(*wrong).error().code == orca::Code::invalid_argument);
  orca::idl::HolonomicVelocity velocity;
  CHECK(orca::check_command(velocity).ok());
  velocity.left(nan);
  CHECK(orca::check_command(velocity).error().code == orca::Code::invalid_argument);
  const ObjectPtr<MotionCommand> sideways = orca::Loan<MotionCommand>(orca::slide(0.1, nan, 0.0));
  CHECK(orca::check_command(*sideways).ok());
  CHECK(orca::check_command(sideways).error().code == orca::Code::invalid_argument);
  orca::idl::TurretCommand turret;
  CHECK(orca::check_command(turret).ok());
  turret.angle(-INFINITY);
  CHECK(orca::check_command(turret).error().code == orca::Code::invalid_argument);
}

TEST_CASE("a full stop is never refused, whatever its other fields hold", "[idl][motion]") {
  auto stop = orca::full_stop();
  stop->speed(std::numeric_limits<double>::quiet_NaN());
  stop->weight(-1.0);
  CHECK(orca::check_command(*stop).ok());
}

TEST_CASE("a velocity for a base that moves sideways is a motion command with one speed more",
          "[idl][motion]") {
  const ObjectPtr<MotionCommand> sideways = orca::Loan<MotionCommand>(orca::slide(0.1, -0.3, 0.5, 2.0));
  CHECK(sideways->speed() == 0.1);
  CHECK(sideways->turn_rate() == 0.5);
  CHECK(sideways->weight() == 2.0);
  CHECK(orca::sideways_speed(sideways) == -0.3);
  const ObjectPtr<MotionCommand> ahead = orca::turn(0.5, 0.1);
  CHECK(orca::sideways_speed(ahead) == 0.0);
}

TEST_CASE("head asks for a direction and turn for a turn rate", "[idl][motion]") {
  const ObjectPtr<MotionCommand> ahead = orca::head(0.5, 0.3, 2.0);
  CHECK(ahead->kind() == orca::idl::NORMAL);
  CHECK(ahead->steering() == orca::idl::BY_DIRECTION);
  CHECK(ahead->direction() == 0.5);
  CHECK(ahead->speed() == 0.3);
  CHECK(ahead->weight() == 2.0);
  const ObjectPtr<MotionCommand> around = orca::turn(-0.5, 0.1);
  CHECK(around->steering() == orca::idl::BY_TURN_RATE);
  CHECK(around->turn_rate() == -0.5);
  CHECK(around->direction() == 0.0);
  CHECK(around->weight() == 1.0);
}

TEST_CASE("a component chooses between commands by plain comparisons of ranges", "[idl][motion]") {
  auto readings = orca::make_object<orca::idl::SonarRangeReadings>();
  readings->ranges({3.0, 0.4});
  const ObjectPtr<orca::idl::SonarRangeReadings> echoes = std::move(readings);
  const auto near = [](double range) { return range < 0.5; };
  const ObjectPtr<MotionCommand> motion =
      std::ranges::any_of(echoes->ranges(), near) ? orca::full_stop() : orca::dont_care();
  CHECK(motion->kind() == orca::idl::FULLSTOP);
}

TEST_CASE("an instant survives the way into an object and back", "[idl][time]") {
  const orca::TimePoint instant{orca::Duration{1'700'000'000'123'456'789}};
  CHECK(orca::to_time_value(instant).ns() == 1'700'000'000'123'456'789);
  CHECK(orca::to_time_point(orca::to_time_value(instant)) == instant);
}

TEST_CASE("make_frame places something level at a point", "[idl][geometry]") {
  const orca::idl::Frame3D frame = orca::make_frame(orca::make_point(0.1, -0.2, 0.3), 1.5);
  CHECK(frame.position().x() == 0.1);
  CHECK(frame.position().y() == -0.2);
  CHECK(frame.position().z() == 0.3);
  CHECK(frame.rotation().roll() == 0.0);
  CHECK(frame.rotation().pitch() == 0.0);
  CHECK(frame.rotation().yaw() == 1.5);
}

TEST_CASE("a gripper's command may hold only motions that there are", "[idl][motion]") {
  orca::idl::GripperCommand gripper;
  gripper.paddles(orca::idl::PADDLES_CLOSE);
  gripper.lift(orca::idl::LIFT_DOWN);
  CHECK(orca::check_command(gripper).ok());
  gripper.lift(static_cast<orca::idl::LiftMotion>(3));
  CHECK(orca::check_command(gripper).error().code == orca::Code::invalid_argument);
}
