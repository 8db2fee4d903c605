// SPDX-License-Identifier: GPL-3.0-or-later
// The seat of a driver: what a server notices while the driver closes its device and opens it again.
#include <catch2/catch.hpp>

#include "patient_executives.hpp"
#include "scout_base.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::HardwareState;

namespace {

// A base that somebody drives and listens to.
struct DrivenBase : ScoutBase {
  explicit DrivenBase(Executive& used) : ScoutBase(used) {
    run();
    client.odometry.subscribe();
    REQUIRE(client.odometry.get_update_wait_max(5s));
    REQUIRE(client.motion.send(turn(0.25, 0.5)).ok());
    REQUIRE(robot.notes("drive 0.5 0.25"));
  }

  // Closes the device in a pause.
  void close() {
    seat.pause("a test");
    robot.end();
    REQUIRE(robot.scout.state() == HardwareState::closed);
  }
};

}  // namespace

PATIENT_CASE("a driver that was closed opens its device again, for as many users as there are",
             "[hw][seat]") {
  DrivenBase base(executive);
  base.close();
  base.robot.scout.run();
  base.seat.resume(base.robot.scout, {});
  CHECK(base.gets(HardwareState::active));
  base.client.odometry.unsubscribe();
  CHECK(base.gets(HardwareState::ready));
}

PATIENT_CASE("in a pause the base stands, a command is refused, and the server works on", "[hw][seat]") {
  DrivenBase base(executive);
  base.close();
  CHECK(base.robot.diary.has("drive 0 0"));
  CHECK(base.seat.state() == HardwareState::active);
  idl::MotionCommand ahead;
  ahead.speed(0.5);
  const Status refused = base.seat.command(ahead);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::unavailable);
  CHECK_THAT(refused.error().text(), Contains("the base is held: a test"));
  sleep(executive, 300ms);
  CHECK(base.bench.working());
}

EXECUTIVE_CASE("after a pause the numbers of the readings go on, and nothing moves before the next command",
               "[hw][seat]") {
  DrivenBase base(executive);
  base.close();
  const std::uint64_t last = base.client.odometry.latest()->seq();
  base.robot.scout.run();
  base.seat.resume(base.robot.scout, {});
  CHECK(eventually(executive, [&] { return base.client.odometry.latest()->seq() > last; }));
  CHECK(base.robot.diary.lines().back() != "drive 0.5 0.25");
  REQUIRE(base.client.motion.send(turn(0.5, 0.5)).ok());
  CHECK(base.robot.notes("drive 0.5 0.5"));
}

EXECUTIVE_CASE("a query after a pause is answered with a reading since then, not with an older one",
               "[hw][seat]") {
  DrivenBase base(executive);
  base.close();
  const TimePoint closed = executive.now();
  base.robot.scout.run();
  base.seat.resume(base.robot.scout, {});
  const auto odometry = base.client.ask_odometry.query(make_object<idl::AskReading>(), 5s);
  REQUIRE(odometry.has_value());
  CHECK(to_time_point((*odometry)->stamp()) >= closed);
}

EXECUTIVE_CASE("an emergency stop outlives a pause, and its release in the pause is not forgotten",
               "[hw][seat]") {
  DrivenBase base(executive);
  base.seat.hold("emergency stop");
  base.close();
  base.robot.scout.run();
  base.seat.resume(base.robot.scout, {});
  REQUIRE(base.gets(HardwareState::active));
  idl::MotionCommand ahead;
  ahead.speed(0.5);
  CHECK_THAT(base.seat.command(ahead).error().text(), Contains("the base is held: emergency stop"));
  base.close();
  base.seat.let_go();
  base.robot.scout.run();
  base.seat.resume(base.robot.scout, {});
  REQUIRE(base.gets(HardwareState::active));
  CHECK(base.seat.command(ahead).ok());
}

EXECUTIVE_CASE("a driver that has left the seat wakes nobody any more", "[hw][seat]") {
  RunningScout before(executive);
  RunningScout after(executive);
  REQUIRE(before.gets(HardwareState::ready));
  REQUIRE(after.gets(HardwareState::ready));
  hw::HardwareSeat seat(before.scout);
  Peer watcher(executive, "watcher");
  seat.watch(watcher.strand());
  seat.pause("a test");
  before.end();
  seat.resume(after.scout, {});
  watcher.strand().pause_until(executive.now());  // takes in what has woken it so far
  const TimePoint begin = executive.now();
  before.scout.run();
  watcher.strand().pause_until(begin + 100ms);
  CHECK(before.scout.state() == HardwareState::ready);
  CHECK(executive.now() - begin >= 100ms);
  seat.watch(watcher.strand(), false);
}

EXECUTIVE_CASE("a pause that does not end is a fault for the server", "[hw][seat]") {
  DrivenBase base(executive);
  base.close();
  base.seat.give_up("the device is stuck");
  CHECK(eventually(executive, [&] {
    return base.bench.diary().has("failed in work: the hardware failed: the device is stuck");
  }));
}
