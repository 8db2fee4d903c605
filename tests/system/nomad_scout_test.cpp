// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of Nomad Scouts with the controller's emulation at the other end of a line in memory, in virtual time; two cases at the end
// have a pseudo terminal and real time.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <string>

#include "base_on_desk.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::NomadScoutFirmware;
using emulators::NomadScoutSettings;

namespace {

using Scout = VirtualBase<NomadScoutFirmware>;
using ScoutInRealTime = BaseOn<DeviceOnDesk, NomadScoutFirmware>;

constexpr int kDrive = 5;  // VM
constexpr int kStop = 9;   // ST
constexpr int kLimp = 10;  // LP

Run run(const Words& more = {}, const std::function<void()>& script = {}) {
  return run_virtual(on_line("nomad_scout.xml", "memory:scout", more), script);
}

Duration watchdog(Scout& scout) { return scout.ask(&NomadScoutFirmware::watchdog); }

}  // namespace

TEST_CASE("a Scout's motors are off before it drives, and it is stopped at the end", "[system][hardware]") {
  Scout scout("scout");
  scout.check_at_goal(run());
  CHECK(watchdog(scout) == 1s);
  CHECK_FALSE(scout.ask(&NomadScoutFirmware::fires_sonars));
  const std::vector<int> all = scout.ask(&NomadScoutFirmware::commands);
  const auto first = [&](int type) { return std::ranges::find(all, type) - all.begin(); };
  CHECK(first(kLimp) < first(kDrive));
  CHECK(first(kStop) > first(kDrive));  // which would give them power
  const auto last = [&](int type) {
    return std::ranges::find(all.rbegin(), all.rend(), type) - all.rbegin();
  };
  CHECK(last(kStop) < last(kDrive));
}

TEST_CASE("the rate of a Scout's line is found", "[system][hardware]") {
  NomadScoutSettings settings;
  settings.baud = GENERATE(4800U, 9600U, 19200U);
  Scout scout("scout", settings);
  const Run ended = run();
  CHECK(ended.exit_code() == 0);
  CHECK(ended.says("connected to a Nomad Scout at " + std::to_string(settings.baud) + " baud"));
}

TEST_CASE("without a Scout on the line nothing starts, and what to look at is said", "[system][hardware]") {
  Scout scout("scout");
  scout.fall_silent(true);
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err, Contains("no Scout answers at memory:scout at 38400, 19200, 9600, 4800 baud; is it "
                                 "switched on"));
}

TEST_CASE("a loop instead of a Scout is told apart", "[system][hardware]") {
  Scout scout("scout");
  scout.echo(true);
  scout.spoil([](std::vector<std::uint8_t>& sent) { sent.clear(); });
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err, Contains("sends back what it is sent"));
}

TEST_CASE(
    "a Scout that is unplugged while it drives stops by itself; it comes back and stands until it is let go",
    "[system][hardware]") {
  Scout scout("scout");
  const Run ended = run(far_goal(), [&] {
    scout.set_off();
    scout.unplug();
    REQUIRE(bench().until([&] { return scout.stands(); }, 1100ms));  // its own watchdog
    CHECK(scout.watchdog_stops() == 1);
    CHECK(bench().until_log("the other end of the line is closed"));
    const double there = scout.pose().x;
    scout.plug_in();
    REQUIRE(bench().until_log("it works again"));
    bench().sleep(500ms);
    CHECK(scout.pose().x == there);
    CHECK_FALSE(scout.has_power());
    scout.check_waits_for_operator();
  });
  CHECK(ended.exit_code() == 0);
}

TEST_CASE(
    "a Scout's controller that is switched off and on in mid-motion is found again, and the robot stands",
    "[system][hardware]") {
  NomadScoutSettings settings;
  // It answers again before its silence is noticed, or after.
  settings.power_up = GENERATE(Duration{0}, Duration{2s});
  Scout scout("scout", settings);
  (void)run(far_goal(), [&] {
    scout.set_off();
    bench().sleep(1s);  // its clock must be seen to go back
    scout.reset();
    const double there = scout.pose().x;
    REQUIRE(bench().until_log(settings.power_up == Duration{0}
                                  ? "its controller has started anew; was it switched off and on"
                                  : "is it still connected and switched on?"));
    REQUIRE(bench().until_log("it works again"));
    bench().sleep(500ms);
    CHECK(scout.stands());
    CHECK(scout.pose().x - there < 0.05);
    CHECK_FALSE(scout.has_power());
    CHECK(watchdog(scout) == 1s);
  });
}

TEST_CASE("a Scout that touches something stands, and does not drive on towards it", "[system][hardware]") {
  Scout scout("scout");
  (void)run(far_goal(), [&] {
    scout.set_off();
    scout.body([](PlainBody& body) { body.touch(8); });  // whatever switch that is
    scout.check_stays();
  });
}

TEST_CASE("a Scout's sonars reach who avoids obstacles", "[system][hardware]") {
  Scout scout("scout");
  scout.body([](PlainBody& body) { body.surround(0.2); });
  (void)run(far_goal(), [&] {
    REQUIRE(bench().until([&] { return scout.ask(&NomadScoutFirmware::fires_sonars); }));
    bench().sleep(3s);
    CHECK(std::abs(scout.pose().x) < 0.1);
    scout.body([](PlainBody& body) { body.surround({}); });
    CHECK(bench().until([&] { return scout.pose().x > 0.3; }));
  });
}

TEST_CASE("a Scout gets to its goals over a line with garbage between and within its packets",
          "[system][hardware]") {
  Scout scout("scout");
  // Behind each packet of 48 bytes; and within every seventh or so, where it looks like the beginning of a long packet.
  scout.spoil(GENERATE(0, 1) == 0 ? garbage_after(48, {0x5C, 0x01, 0x2C, 0x00})
                                  : garbage_after(331, {0x01, 0xC8, 0x00, 0x07}));
  scout.check_at_goal(run());
}

TEST_CASE("a Scout drives to its goals over a serial line", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  ScoutInRealTime scout(device);
  scout.check_at_goal(run_deployer(on_line("nomad_scout.xml", device), Seconds(60)));
}

TEST_CASE("kill -9 of the whole system: a Scout's watchdog stops the wheels", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  ScoutInRealTime scout(device);
  (void)kill_while_it_drives(scout, on_line("nomad_scout.xml", device), [&] { return scout.stands(); });
  CHECK(scout.watchdog_stops() == 1);
}
