// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of the Create 2 with the controller's emulation at the other end of a line in memory, in virtual time; two cases at the end
// have a pseudo terminal and real time.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>

#include "base_on_desk.hpp"
#include "orca/emulators/create2_firmware.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::Create2Firmware;
using emulators::Create2Mode;
using emulators::Create2Settings;

namespace {

using Create = VirtualBase<Create2Firmware>;
using CreateInRealTime = BaseOn<DeviceOnDesk, Create2Firmware>;

constexpr int kStart = 128;  // leads to passive mode, in which the wheels stand
constexpr int kSafe = 131;
constexpr int kDriveDirect = 145;

Run run(const Words& more = {}, const std::function<void()>& script = {}) {
  return run_virtual(on_line("create2.xml", "memory:create", more), script);
}

template <class AnyCreate>
Create2Mode mode(AnyCreate& create) {
  return create.ask(&Create2Firmware::mode);
}
template <class AnyCreate>
std::vector<int> commands(AnyCreate& create) {
  return create.ask(&Create2Firmware::commands);
}

// Checks that it stands in passive mode until an operator lets it go.
void check_waits(Create& create) {
  bench().sleep(500ms);
  CHECK(create.stands());
  CHECK(mode(create) == Create2Mode::passive);
  create.check_waits_for_operator();
}

}  // namespace

TEST_CASE("a Create 2's safe mode comes with the first command to move, and its interface is off at the end",
          "[system][hardware]") {
  Create create("create");
  create.check_at_goal(run());
  CHECK(mode(create) == Create2Mode::off);
  const std::vector<int> all = commands(create);
  const auto safe = std::ranges::find(all, kSafe);
  REQUIRE(safe != all.end());
  CHECK(std::ranges::find(all, kDriveDirect) - safe == 1);
}

TEST_CASE("the rate of a Create 2 that was started with 19200 baud is found", "[system][hardware]") {
  Create2Settings settings;
  settings.baud = 19200;
  Create create("create", settings);
  const Run ended = run();
  CHECK(ended.exit_code() == 0);
  CHECK(ended.says("connected to a Create 2 at 19200 baud"));
}

TEST_CASE("a byte log of a base that is asked nothing, and sends all the time, is played back",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string log = folder.file("bytes");
  {
    Create create("create");
    CHECK(run({"--set", "create.byte_log=" + log}).exit_code() == 0);
  }
  const Run played =
      run_deployer(on_line("create2.xml", "replay:" + log, {"--until", "3 s"}) + virtual_clock());
  INFO(played.err);
  CHECK(played.exit_code() == 0);
  CHECK(played.says("connected to a Create 2"));
  CHECK_FALSE(played.says("nothing has come from it"));
}

TEST_CASE("a Roomba whose firmware reports its mode plus one drives to its goals", "[system][hardware]") {
  Create2Settings settings;
  settings.mode_offset = 1;
  Create create("create", settings);
  create.check_at_goal(run());
}

TEST_CASE("a Create 2 whose battery is nearly empty drives on, and it is said once", "[system][hardware]") {
  Create2Settings settings;
  settings.charge = 250;  // of 2,500 mAh
  Create create("create", settings);
  const Run ended = run();
  CHECK(ended.exit_code() == 0);
  const std::size_t first = ended.err.find("its battery is low, at 10 % of its charge");
  CHECK(first != std::string::npos);
  CHECK(ended.err.find("its battery is low", first + 1) == std::string::npos);
}

TEST_CASE("without a Create 2 on the line nothing starts, and what to look at is said",
          "[system][hardware]") {
  Create create("create");
  create.fall_silent(true);
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err,
             Contains("no Create 2 answers at memory:create at 115200, 19200 baud; press its Clean "
                      "button"));
}

TEST_CASE("a Create 2 that is unplugged drives on, is stopped when it is back, and stands until it is let go",
          "[system][hardware]") {
  Create create("create");
  const Run ended = run(far_goal(), [&] {
    create.set_off();
    create.unplug();
    CHECK(bench().until_log("the other end of the line is closed"));
    bench().sleep(500ms);
    CHECK_FALSE(create.stands());  // it has no watchdog
    create.plug_in();
    REQUIRE(bench().until_log("it works again"));
    CHECK(create.stands());
    check_waits(create);
  });
  CHECK(ended.exit_code() == 0);
}

TEST_CASE("a Create 2 that is switched off and on in mid-motion is found again, and stands",
          "[system][hardware]") {
  Create create("create");
  (void)run(far_goal(), [&] {
    create.set_off();
    create.reset();
    CHECK(bench().until_log("is it still connected and switched on?"));
    REQUIRE(bench().until_log("it works again"));
    check_waits(create);
  });
}

TEST_CASE("a Create 2 that bumps into something stands, and does not drive on towards it",
          "[system][hardware]") {
  Create create("create");
  (void)run(far_goal(), [&] {
    create.set_off();
    create.body([](PlainBody& body) { body.touch(1); });
    create.check_stays();
  });
}

TEST_CASE("a Create 2 stops at a cliff, and is not driven on over it", "[system][hardware]") {
  Create create("create");
  (void)run(far_goal(), [&] {
    create.set_off();
    create.body([](PlainBody& body) { body.drop(2); });
    create.check_stays();
    CHECK(mode(create) == Create2Mode::passive);
    CHECK(create.ask(&Create2Firmware::safety_stops) == 1);
  });
}

TEST_CASE("a Create 2 that is lifted up or connected to its charger stands until it is let go",
          "[system][hardware]") {
  Create create("create");
  const bool is_lift = GENERATE(true, false);
  const auto disturb = [&](bool on) {
    create.with([&](Create::Line& line, PlainBody& body) {
      is_lift ? body.lift(on) : line.device().connect_charger(on);
    });
  };
  (void)run(far_goal(), [&] {
    create.set_off();
    disturb(true);
    CHECK(bench().until_log(is_lift ? "a wheel hangs; put it down" : "it is connected to its charger"));
    CHECK(bench().until([&] { return create.stands(); }));
    disturb(false);
    check_waits(create);
  });
}

TEST_CASE("a Create 2 that is held is told to stop, although it would drive on by itself",
          "[system][hardware]") {
  Create2Settings settings;
  settings.heeds_charger = false;
  Create create("create", settings);
  (void)run(far_goal(), [&] {
    create.set_off();
    create.look([](Create2Firmware& firmware) { firmware.connect_charger(true); });
    CHECK(bench().until_log("alarm ESTOP: the base is held: it is connected to its charger"));
    CHECK(bench().until([&] { return create.stands(); }));
    CHECK(mode(create) == Create2Mode::safe);
  });
}

TEST_CASE("a Create 2 drives to its goals over a serial line, and its interface is off after",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  CreateInRealTime create(device);
  create.check_at_goal(run_deployer(on_line("create2.xml", device), Seconds(60)));
  CHECK(mode(create) == Create2Mode::off);
}

TEST_CASE(
    "kill -9 of the whole system: a Create 2 drives on, for it has no watchdog, and the next start stops it "
    "first",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  CreateInRealTime create(device);
  (void)kill_while_it_drives(create, on_line("create2.xml", device), [] { return true; });
  std::this_thread::sleep_for(1s);
  CHECK(create.moves());
  const std::size_t before = commands(create).size();
  const Run again = run_deployer(on_line("create2.xml", device, {"--set", "goals=here: 0 0"}), Seconds(60));
  INFO(again.err);
  CHECK(again.exit_code() == 0);
  REQUIRE(commands(create).size() > before);
  CHECK(commands(create)[before] == kStart);
  CHECK(create.stands());
}
