// SPDX-License-Identifier: GPL-3.0-or-later
// A hardware container whose device may come back: it is opened again after a while, and its base stands until an operator lets
// it move. Cases that mostly wait have a virtual clock, and threads in the slow tests; one shows always that recovery works on threads.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>

#include "fake_scout.hpp"
#include "patient_executives.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::HardwareState;

namespace {

// The outside of a device on a cable, as the test changes it.
struct Outside {
  std::atomic<bool> plugged{true};
  std::atomic<bool> answers{true};  // to the driver's probe
  std::atomic<bool> speaks{true};   // of its own
  std::atomic<int> descriptor{-1};
  std::atomic<int> read{0};  // sum of the bytes that came from it
};

class CableScout final : public FakeScout {
 public:
  CableScout(hw::HardwareHost& host, Diary& diary, Outside& outside)
      : FakeScout(host, diary), outside_(outside) {
    const auto cable = [&outside] {
      return outside.plugged ? ok() : fail(Code::unavailable, "no such port");
    };
    trouble = {{"open", cable}, {"poll", cable}};
  }
  ~CableScout() override {
    shut_down();
    CHECK(join_until(host().now() + 5s));
  }

 private:
  Result<bool> probe() override { return outside_.answers.load(); }
  [[nodiscard]] bool recovers() const override { return true; }
  [[nodiscard]] int descriptor() const override { return outside_.descriptor; }
  [[nodiscard]] Duration longest_silence() const override {
    return outside_.descriptor < 0 ? 300ms : Duration::max();
  }
  Status poll() override {
    if (outside_.speaks) heard();
    char byte = 0;
    if (outside_.descriptor >= 0 && read(outside_.descriptor, &byte, 1) == 1)
      outside_.read = outside_.read + byte;
    return FakeScout::poll();
  }
  // With a descriptor only its input leads to a poll.
  [[nodiscard]] TimePoint next_poll() const override {
    return outside_.descriptor < 0 ? FakeScout::next_poll() : kForever;
  }

  Outside& outside_;
};

// A running one.
struct CableRobot {
  explicit CableRobot(Executive& used) : executive(used), host(used, diary), scout(host, diary, outside) {}
  [[nodiscard]] bool gets(HardwareState state) {
    return eventually(executive, [&] { return scout.state() == state; });
  }
  [[nodiscard]] long count(const std::string& line) const {
    const auto lines = diary.lines();
    return std::ranges::count(lines, line);
  }
  void drive() {
    scout.run();
    scout.acquire();
    REQUIRE(gets(HardwareState::active));
    REQUIRE(scout.command(*turn(0.25, 0.5)).ok());
    REQUIRE(eventually(executive, [&] { return diary.has("drive 0.5 0.25"); }));
  }

  Executive& executive;
  Outside outside;
  Diary diary;
  FakeHardwareHost host;
  CableScout scout;
};

}  // namespace

PATIENT_CASE("a device that is unplugged stops its motors, and works again when it is back",
             "[hw][recovery]") {
  CableRobot robot(executive);
  robot.drive();
  robot.outside.plugged = false;
  REQUIRE(robot.gets(HardwareState::backoff));
  CHECK_FALSE(robot.scout.is_lost());
  CHECK(robot.scout.fault() == "no such port");
  CHECK(robot.diary.has("drive 0 0"));
  CHECK(robot.diary.has("-> Fault"));
  CHECK(robot.diary.has("close"));
  CHECK_FALSE(robot.scout.command(*turn(0.25, 0.5)).ok());
  sleep(executive, 1200ms);
  CHECK(robot.scout.state() == HardwareState::backoff);
  robot.outside.plugged = true;
  REQUIRE(eventually(executive, [&] { return robot.scout.state() == HardwareState::active; }));
  CHECK(robot.count("start") == 2);
  CHECK(robot.diary.has("log: it works again"));
}

EXECUTIVE_CASE("the base of a device that came back stands until an operator lets it move",
               "[hw][recovery]") {
  CableRobot robot(executive);
  robot.drive();
  robot.outside.plugged = false;
  REQUIRE(robot.gets(HardwareState::backoff));
  robot.outside.plugged = true;
  REQUIRE(robot.gets(HardwareState::active));
  const long driven = robot.count("drive 0.5 0.25");
  const Status refused = robot.scout.command(*turn(0.25, 0.5));
  REQUIRE_FALSE(refused.ok());
  CHECK_THAT(refused.error().text(), Contains("it has failed; orcactl estop --release lets it move again"));
  sleep(executive, 30ms);
  CHECK(robot.count("drive 0.5 0.25") == driven);
  robot.scout.wheels().let_go();
  CHECK(robot.scout.command(*turn(0.25, 0.5)).ok());
  CHECK(eventually(executive, [&] { return robot.count("drive 0.5 0.25") == driven + 1; }));
}

EXECUTIVE_CASE("a base that is held without an order is reported until it is let go, and an order is not",
               "[hw][recovery]") {
  CableRobot robot(executive);
  robot.drive();
  robot.scout.hold("emergency stop");
  sleep(executive, 30ms);
  CHECK(robot.scout.let_go());
  robot.scout.wheels().hold("its button was pressed");
  CHECK(eventually(executive, [&] { return robot.diary.has("held: its button was pressed"); }));
  CHECK(robot.scout.let_go());
  CHECK(eventually(executive, [&] { return robot.diary.has("obeys again"); }));
  robot.outside.plugged = false;
  REQUIRE(robot.gets(HardwareState::backoff));
  const std::string failed = "held: it has failed; orcactl estop --release lets it move again";
  CHECK(eventually(executive, [&] { return robot.diary.has(failed); }));
  CHECK_FALSE(robot.diary.has("held: emergency stop"));
  CHECK(robot.count("obeys again") == 1);
}

TEST_CASE("a device that stays away is told once, and asked for less and less often", "[hw][recovery]") {
  run_on_each({{ClockKind::virtual_time, Backend::baton}}, [](Executive& executive) {
    CableRobot robot(executive);
    robot.drive();
    robot.outside.plugged = false;
    REQUIRE(robot.gets(HardwareState::backoff));
    const TimePoint since = executive.now();
    sleep(executive, 60s);
    CHECK(robot.count("log: no such port") == 1);
    CHECK(robot.count("-> Fault") == 1);
    // After 0.5, 1, 2, 4 s and then each 5 s.
    CHECK(robot.count("open") - 1 ==
          4 + static_cast<long>((to_seconds(executive.now() - since) - 7.5) / 5.0));
  });
}

PATIENT_CASE("a device that fails for one reason after the other is told each, and comes back",
             "[hw][recovery]") {
  CableRobot robot(executive);
  std::atomic<const char*> reason{"the device has gone"};
  robot.scout.trouble["open"] = robot.scout.trouble["poll"] = [&] {
    return robot.outside.plugged ? ok() : fail(Code::unavailable, reason.load());
  };
  robot.drive();
  robot.outside.plugged = false;
  REQUIRE(robot.gets(HardwareState::backoff));
  reason = "no such port";
  REQUIRE(eventually(executive, [&] { return robot.diary.has("log: no such port"); }));
  REQUIRE(robot.gets(HardwareState::backoff));
  robot.outside.plugged = true;
  REQUIRE(robot.gets(HardwareState::active));
  CHECK(robot.count("-> Fault") == 2);
}

PATIENT_CASE("a device that was never there is a fault for good: the system does not start",
             "[hw][recovery]") {
  CableRobot robot(executive);
  robot.outside.plugged = false;
  robot.scout.run();
  REQUIRE(robot.gets(HardwareState::fault));
  CHECK(robot.scout.is_lost());
  sleep(executive, 700ms);
  CHECK(robot.count("open") == 1);
}

PATIENT_CASE("a container is probing until its driver knows what is there, and can be shut down meanwhile",
             "[hw][recovery]") {
  CableRobot robot(executive);
  robot.outside.answers = false;
  robot.scout.run();
  REQUIRE(robot.gets(HardwareState::probing));
  CHECK_FALSE(robot.scout.command(*turn(0.25, 0.5)).ok());
  sleep(executive, 500ms);  // longer than it may be silent while it works
  CHECK(robot.scout.state() == HardwareState::probing);
  robot.outside.answers = true;
  REQUIRE(robot.gets(HardwareState::ready));
  robot.scout.shut_down();
  CHECK(robot.scout.join_until(executive.now() + 5s));
  robot.outside.answers = false;
  robot.scout.run();
  REQUIRE(robot.gets(HardwareState::probing));
  robot.scout.shut_down();
  CHECK(robot.scout.join_until(executive.now() + 5s));
  CHECK(robot.scout.state() == HardwareState::closed);
  CHECK(robot.diary.lines().back() == "-> Closed");
}

PATIENT_CASE("a device that falls silent has failed, with advice", "[hw][recovery]") {
  CableRobot robot(executive);
  robot.drive();
  robot.outside.speaks = false;
  REQUIRE(robot.gets(HardwareState::backoff));
  CHECK(robot.scout.fault() == "nothing has come from it for 0.3 s; is it still connected and switched on?");
  robot.outside.speaks = true;
  REQUIRE(robot.gets(HardwareState::active));
}

EXECUTIVE_CASE("a container in backoff can be shut down", "[hw][recovery]") {
  CableRobot robot(executive);
  robot.drive();
  robot.outside.plugged = false;
  REQUIRE(robot.gets(HardwareState::backoff));
  robot.scout.shut_down();
  CHECK(robot.scout.join_until(executive.now() + 5s));
  CHECK(robot.scout.state() == HardwareState::closed);
}

TEST_CASE("input is read when it comes, whatever the driver's period, on every executive of the steady clock",
          "[hw][recovery]") {
  run_on_each({{ClockKind::steady, Backend::thread}, {ClockKind::steady, Backend::fiber}},
              [](Executive& executive) {
                int ends[2];
                REQUIRE(pipe2(ends, O_NONBLOCK) == 0);
                {
                  CableRobot robot(executive);
                  robot.outside.descriptor = ends[0];
                  robot.scout.run();
                  REQUIRE(robot.gets(HardwareState::ready));
                  for (int i = 1; i <= 20; ++i) {
                    REQUIRE(write(ends[1], "\1", 1) == 1);
                    REQUIRE(eventually(executive, [&] { return robot.outside.read == i; }));
                  }
                }
                close(ends[0]);
                close(ends[1]);
              });
}
