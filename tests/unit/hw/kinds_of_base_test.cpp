// SPDX-License-Identifier: GPL-3.0-or-later
// What a server offers for bases that can do more than drive and turn.
#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

#include "patient_executives.hpp"
#include "scout_base.hpp"

using namespace orca;
using namespace orca::test;
using hw::HardwareState;

namespace {

hw::DriveLimits with(idl::DriveType type) {
  hw::DriveLimits limits = kScoutLimits;
  limits.type = type;
  return limits;
}

bool offers(ScoutBase& base, const std::string& port) {
  return std::ranges::any_of(base.bench.peer().endpoints(),
                             [&](const auto& e) { return e->contract().name == port; });
}

Loan<idl::HolonomicVelocity> straight_velocity(double forward, double left) {
  auto made = make_object<idl::HolonomicVelocity>();
  made->speed(forward);
  made->left(left);
  return made;
}

Loan<idl::TurretCommand> pointing(double angle) {
  auto made = make_object<idl::TurretCommand>();
  made->angle(angle);
  return made;
}

ObjectRef sealed(Loan<idl::TurretCommand> command) { return ObjectLoan(std::move(command)).seal(); }

/// What the turret was told, in order.
std::vector<std::string> told(const ScoutBase& base) {
  std::vector<std::string> lines = base.robot.diary.lines();
  std::erase_if(lines, [](const std::string& line) { return !line.starts_with("turret"); });
  return lines;
}

/// A base with a turret, connected and running.
struct Nomad : ScoutBase {
  explicit Nomad(Executive& used, std::map<std::string, std::function<Status()>> trouble = {})
      : ScoutBase(used, std::move(trouble), with(idl::SYNCHRO), true) {
    connect("turret", "TurretCommandSend");
    run();
  }
};

}  // namespace

EXECUTIVE_CASE("a server offers a port only for what its base can do", "[hw][server][motion]") {
  ScoutBase plain(executive);
  CHECK(offers(plain, "MotionCommandSend"));
  CHECK_FALSE(offers(plain, "HolonomicVelocitySend"));
  CHECK_FALSE(offers(plain, "TurretCommandSend"));
  ScoutBase omni(executive, {}, with(idl::HOLONOMIC));
  CHECK(offers(omni, "MotionCommandSend"));
  CHECK(offers(omni, "HolonomicVelocitySend"));
  CHECK_FALSE(offers(omni, "TurretCommandSend"));
  ScoutBase nomad(executive, {}, with(idl::SYNCHRO), true);
  CHECK_FALSE(offers(nomad, "HolonomicVelocitySend"));
  CHECK(offers(nomad, "TurretCommandSend"));
}

PATIENT_CASE("a holonomic velocity starts an idle base, is carried out, and expires",
             "[hw][server][motion]") {
  ScoutBase base(executive, {}, with(idl::HOLONOMIC));
  base.connect("velocity", "HolonomicVelocitySend");
  base.run();
  REQUIRE(base.client.velocity.send(straight_velocity(0.25, -0.5)).ok());
  CHECK(base.robot.notes("drive 0.25 0 left -0.5"));
  CHECK(base.robot.notes("drive 0 0 left 0"));
  CHECK(base.gets(HardwareState::ready));
}

EXECUTIVE_CASE(
    "a motion command with a sideways speed is carried out by a base that can, and refused by others",
    "[hw][server][motion]") {
  ScoutBase omni(executive, {}, with(idl::HOLONOMIC));
  omni.run();
  REQUIRE(omni.client.motion.send(slide(0.25, -0.5, 0.125)).ok());
  CHECK(omni.robot.notes("drive 0.25 0.125 left -0.5"));
  ScoutBase plain(executive);
  plain.run();
  REQUIRE(plain.client.motion.send(slide(0.25, -0.5, 0.125)).ok());
  const auto& port = static_cast<SendServerEndpoint&>(plain.bench.peer().endpoint("MotionCommandSend"));
  CHECK(eventually(executive, [&] { return port.counters().failed == 1; }));
  CHECK_FALSE(plain.robot.diary.has("drive 0.25 0.125"));
  // It stops all the same.
  REQUIRE(plain.client.motion.send(turn(0.25, 0.5)).ok());
  CHECK(plain.robot.notes("drive 0.5 0.25"));
  REQUIRE(plain.client.motion.send(slide(0.0, 0.0, 0.0)).ok());
  CHECK(plain.robot.notes("drive 0 0"));
  CHECK(port.counters().failed == 1);
}

EXECUTIVE_CASE("a holonomic velocity of zero stops a moving base at once and releases it",
               "[hw][server][motion]") {
  ScoutBase base(executive, {}, with(idl::HOLONOMIC));
  base.connect("velocity", "HolonomicVelocitySend");
  base.run();
  REQUIRE(base.client.velocity.send(straight_velocity(0.0, 0.5)).ok());
  REQUIRE(base.robot.notes("drive 0 0 left 0.5"));
  const TimePoint sent = executive.now();
  REQUIRE(base.client.velocity.send(straight_velocity(0.0, 0.0)).ok());
  CHECK(base.robot.notes("drive 0 0 left 0"));
  if (executive.is_virtual()) CHECK(executive.now() - sent < 10ms);
  CHECK(base.gets(HardwareState::ready));
}

PATIENT_CASE(
    "the command of an actuator starts idle hardware, and is not undone when the hardware is released",
    "[hw][server][actuators]") {
  Nomad base(executive);
  REQUIRE(base.client.turret.send(pointing(1.5)).ok());
  CHECK(base.robot.notes("turret 1.5"));
  CHECK(base.gets(HardwareState::ready));
  REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
  CHECK(base.robot.notes("drive 0.5 0.25"));
  CHECK(told(base) == std::vector<std::string>{"turret 1.5"});
  CHECK_FALSE(base.robot.diary.has("halt turret"));
}

EXECUTIVE_CASE("an actuator carries out all commands in their order", "[hw][server][actuators]") {
  Nomad base(executive);
  for (const double angle : {0.5, 1.0, 0.25}) REQUIRE(base.client.turret.send(pointing(angle)).ok());
  REQUIRE(base.robot.notes("turret 0.25"));
  CHECK(told(base) == std::vector<std::string>{"turret 0.5", "turret 1", "turret 0.25"});
}

EXECUTIVE_CASE("an emergency stop halts an actuator where it is, and it refuses commands until that ends",
               "[hw][server][actuators]") {
  Nomad base(executive);
  REQUIRE(base.client.turret.send(pointing(1.5)).ok());
  REQUIRE(base.robot.notes("turret 1.5"));
  base.seat.hold("emergency stop");
  CHECK(base.robot.notes("halt turret"));
  const hw::HardwareSeat::Actuator turret = base.seat.actuators().at(0);
  const Status refused = base.seat.command(turret, sealed(pointing(0.5)));
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::unavailable);
  CHECK_THAT(refused.error().text(), Catch::Contains("emergency stop"));
  CHECK(base.seat.let_go());
  CHECK(base.seat.command(turret, sealed(pointing(0.75))).ok());
  CHECK(base.robot.notes("turret 0.75"));
  CHECK_FALSE(base.robot.diary.has("turret 0.5"));
}

EXECUTIVE_CASE("an actuator refuses what no device can carry out", "[hw][server][actuators]") {
  Nomad base(executive);
  const ObjectRef nowhere = sealed(pointing(std::numeric_limits<double>::quiet_NaN()));
  const Status refused = base.seat.command(base.seat.actuators().at(0), nowhere);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::invalid_argument);
}

EXECUTIVE_CASE("an actuator that does not do what it is told is a fault of the device",
               "[hw][server][actuators]") {
  Nomad base(executive, {{"turret", [] { return Status(fail(Code::unavailable, "the turret is stuck")); }}});
  REQUIRE(base.client.turret.send(pointing(1.5)).ok());
  CHECK(base.gets(HardwareState::fault));
  CHECK_THAT(base.seat.fault(), Catch::Contains("the turret is stuck"));
}
