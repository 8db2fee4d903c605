// SPDX-License-Identifier: GPL-3.0-or-later
// What a server offers for bases that can do more than drive and turn.
#include <catch2/catch.hpp>

#include <algorithm>

#include "scout_base.hpp"

using namespace orca;
using namespace orca::test;
using hw::HardwareState;

namespace {

hw::DriveLimits with(idl::DriveType type, bool turret) {
  hw::DriveLimits limits = kScoutLimits;
  limits.type = type;
  limits.turret = turret;
  return limits;
}

bool offers(ScoutBase& base, const std::string& port) {
  return std::ranges::any_of(base.bench.peer().endpoints(),
                             [&](const auto& e) { return e->contract().name == port; });
}

Loan<idl::HolonomicVelocity> straight_velocity(double forward, double left) {
  auto made = make_object<idl::HolonomicVelocity>();
  made->forward(forward);
  made->left(left);
  return made;
}

}  // namespace

TEST_CASE("a server offers a port only for what its base can do", "[hw][server][motion]") {
  run_on_each(all_executives(), [](Executive& executive) {
    ScoutBase plain(executive);
    CHECK(offers(plain, "MotionCommandSend"));
    CHECK_FALSE(offers(plain, "HolonomicVelocitySend"));
    CHECK_FALSE(offers(plain, "TurretCommandSend"));
    ScoutBase omni(executive, {}, with(idl::HOLONOMIC, false));
    CHECK(offers(omni, "MotionCommandSend"));
    CHECK(offers(omni, "HolonomicVelocitySend"));
    CHECK_FALSE(offers(omni, "TurretCommandSend"));
    ScoutBase nomad(executive, {}, with(idl::SYNCHRO, true));
    CHECK_FALSE(offers(nomad, "HolonomicVelocitySend"));
    CHECK(offers(nomad, "TurretCommandSend"));
  });
}

TEST_CASE("a holonomic velocity starts an idle base, is carried out, and expires", "[hw][server][motion]") {
  run_on_each(all_executives(), [](Executive& executive) {
    ScoutBase base(executive, {}, with(idl::HOLONOMIC, false));
    base.connect("velocity", "HolonomicVelocitySend");
    base.run();
    REQUIRE(base.client.velocity.send(straight_velocity(0.25, -0.5)).ok());
    CHECK(base.robot.notes("drive 0.25 0 left -0.5"));
    CHECK(base.robot.notes("drive 0 0 left 0"));
    CHECK(base.gets(HardwareState::ready));
  });
}

TEST_CASE("a holonomic velocity of zero stops a moving base at once and releases it",
          "[hw][server][motion]") {
  run_on_each(all_executives(), [](Executive& executive) {
    ScoutBase base(executive, {}, with(idl::HOLONOMIC, false));
    base.connect("velocity", "HolonomicVelocitySend");
    base.run();
    REQUIRE(base.client.velocity.send(straight_velocity(0.0, 0.5)).ok());
    REQUIRE(base.robot.notes("drive 0 0 left 0.5"));
    const TimePoint sent = executive.now();
    REQUIRE(base.client.velocity.send(straight_velocity(0.0, 0.0)).ok());
    CHECK(base.robot.notes("drive 0 0 left 0"));
    if (executive.is_virtual()) CHECK(executive.now() - sent < 10ms);
    CHECK(base.gets(HardwareState::ready));
  });
}

TEST_CASE("a turret command starts an idle base, and the turret keeps its angle when the base is released",
          "[hw][server][motion]") {
  run_on_each(all_executives(), [](Executive& executive) {
    ScoutBase base(executive, {}, with(idl::SYNCHRO, true));
    base.connect("turret", "TurretCommandSend");
    base.run();
    auto point = make_object<idl::TurretCommand>();
    point->angle(1.5);
    REQUIRE(base.client.turret.send(std::move(point)).ok());
    CHECK(base.robot.notes("drive 0 0 turret 1.5"));
    CHECK(base.gets(HardwareState::ready));
    CHECK_FALSE(base.robot.diary.has("drive 0 0 turret 0"));
    REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
    CHECK(base.robot.notes("drive 0.5 0.25 turret 1.5"));
  });
}
