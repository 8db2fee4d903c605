// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of Nomad Scouts with the controller's emulation at the other end of a pseudo terminal.
#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>
#include <string>
#include <thread>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::NomadScoutFirmware;
using emulators::NomadScoutSettings;

namespace {

using BadScout = BadLine<NomadScoutFirmware>;
using Scout = DeviceOnDesk<BadScout, PlainBody>;

constexpr int kDrive = 5;  // VM
constexpr int kStop = 9;   // ST
constexpr int kLimp = 10;  // LP

Words drive(const std::string& device, const Words& more = {}) {
  return Words{system_graph("nomad_scout.xml"), "--set", "device=" + device} + more;
}

Words far_goal() { return {"--set", "goals=far: 30 0"}; }

Twist2 velocity(Scout& scout) {
  return scout.with([](BadScout&, PlainBody& body) { return body.velocity(); });
}
bool is_moving(Scout& scout) { return velocity(scout).forward > 0.1; }
bool stands(Scout& scout) { return velocity(scout) == Twist2{}; }
bool has_power(Scout& scout) {
  return scout.with([](BadScout& line, PlainBody&) { return line.device().has_power(); });
}
Pose2 pose(Scout& scout) {
  return scout.with([](BadScout&, PlainBody& body) { return body.odometry(); });
}
int watchdog_stops(Scout& scout) {
  return scout.with([](BadScout& line, PlainBody&) { return line.device().watchdog_stops(); });
}
std::vector<int> commands(Scout& scout) {
  return scout.with([](BadScout& line, PlainBody&) { return line.device().commands(); });
}
void spoil(Scout& scout, const std::function<void(std::vector<std::uint8_t>&)>& change) {
  scout.with([&](BadScout& line, PlainBody&) { line.spoil(change); });
}

// Drives to the goals of the graph, and returns whether the robot got there.
void check_goals(Scout& scout, const std::string& device) {
  const Run run = run_deployer(drive(device), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 2);
  const Pose2 end = pose(scout);
  CHECK(std::hypot(end.x - run.arrivals()[1].x, end.y - run.arrivals()[1].y) < 0.1);
  CHECK(stands(scout));
}

}  // namespace

TEST_CASE("a Scout drives to its goals over a serial line, and its motors are off before",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  Scout scout(device);
  check_goals(scout, device);
  CHECK(scout.with([](BadScout& line, PlainBody&) { return line.device().watchdog(); }) == 1s);
  CHECK_FALSE(scout.with([](BadScout& line, PlainBody&) { return line.device().fires_sonars(); }));
  const std::vector<int> all = commands(scout);
  const auto first = [&](int type) { return std::ranges::find(all, type) - all.begin(); };
  CHECK(first(kLimp) < first(kDrive));
  CHECK(first(kStop) > first(kDrive));  // which would give them power
  const auto last = [&](int type) {
    return std::ranges::find(all.rbegin(), all.rend(), type) - all.rbegin();
  };
  CHECK(last(kStop) < last(kDrive));
}

TEST_CASE("the rate of a Scout's line is found", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  NomadScoutSettings settings;
  settings.baud = GENERATE(4800U, 9600U, 19200U);
  Scout scout(device, settings);
  const Run run = run_deployer(drive(device), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("connected to a Nomad Scout at " + std::to_string(settings.baud) + " baud"));
}

TEST_CASE("without a Scout on the line nothing starts, and what to look at is said", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  Scout scout(device);
  scout.fall_silent(true);
  const Run run = run_deployer(drive(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains("no Scout answers at serial:" + device +
                               " at 38400, 19200, 9600, 4800 baud; is it switched on"));
}

TEST_CASE("a loop instead of a Scout is told apart", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  Scout scout(device);
  scout.with([](BadScout& line, PlainBody&) { line.echo(true); });
  spoil(scout, [](std::vector<std::uint8_t>& sent) { sent.clear(); });
  const Run run = run_deployer(drive(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains("sends back what it is sent"));
}

TEST_CASE(
    "a Scout that is unplugged while it drives stops by itself; it comes back and stands until it is let go",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  Scout scout(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(scout); }));
  scout.unplug();
  REQUIRE(eventually([&] { return stands(scout); }));  // its own watchdog
  CHECK(watchdog_stops(scout) == 1);
  CHECK(program.wait_for_output("the device has gone: was it unplugged or switched off?",
                                Seconds(20 * kSlowdown)));
  const double there = pose(scout).x;
  scout.plug_in();
  const bool back = program.wait_for_output("it works again", Seconds(30));
  INFO(program.err());
  REQUIRE(back);
  std::this_thread::sleep_for(500ms);
  CHECK(pose(scout).x == there);
  CHECK_FALSE(has_power(scout));
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return is_moving(scout); }));
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
}

TEST_CASE(
    "a Scout's controller that is switched off and on in mid-motion is found again, and the robot stands",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  NomadScoutSettings settings;
  // It answers again before its silence is noticed, or after.
  settings.power_up = GENERATE(Duration{0}, Duration{2s});
  Scout scout(device, settings);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(scout); }));
  std::this_thread::sleep_for(1s);  // its clock must be seen to go back
  scout.with([](BadScout& line, PlainBody&) { line.reset(steady_now()); });
  const double there = pose(scout).x;
  const std::string what = settings.power_up == Duration{0}
                               ? "its controller has started anew; was it switched off and on"
                               : "is it still connected and switched on?";
  const bool told = program.wait_for_output(what, Seconds(20 * kSlowdown));
  INFO(program.err());
  REQUIRE(told);
  REQUIRE(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  std::this_thread::sleep_for(500ms);
  CHECK(stands(scout));
  CHECK(pose(scout).x - there < 0.05);
  CHECK_FALSE(has_power(scout));
  CHECK(scout.with([](BadScout& line, PlainBody&) { return line.device().watchdog(); }) == 1s);
}

TEST_CASE("kill -9 of the whole system: a Scout's watchdog stops the wheels", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  Scout scout(device);
  Subprocess program(deployer(drive(device, far_goal() + Words{"--in-process"})));
  REQUIRE(eventually([&] { return is_moving(scout); }));
  program.send(SIGKILL);
  CHECK(eventually([&] { return stands(scout); }));
  CHECK(watchdog_stops(scout) == 1);
}

TEST_CASE("a Scout that touches something stands, and does not drive on towards it", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  Scout scout(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(scout); }));
  scout.with([](BadScout&, PlainBody& body) { body.touch(8); });  // whatever switch that is
  REQUIRE(eventually([&] { return stands(scout); }));
  const double there = pose(scout).x;
  std::this_thread::sleep_for(1s);
  CHECK(pose(scout).x - there < 0.01);
}

TEST_CASE("a Scout's sonars reach who avoids obstacles", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  Scout scout(device);
  scout.with([](BadScout&, PlainBody& body) { body.surround(0.2); });
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually(
      [&] { return scout.with([](BadScout& line, PlainBody&) { return line.device().fires_sonars(); }); }));
  std::this_thread::sleep_for(3s);
  CHECK(std::abs(pose(scout).x) < 0.1);
  scout.with([](BadScout&, PlainBody& body) { body.surround({}); });
  CHECK(eventually([&] { return pose(scout).x > 0.3; }));
}

TEST_CASE("a Scout gets to its goals over a line with garbage between and within its packets",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("scout");
  Scout scout(device);
  // Behind each packet of 48 bytes; and within every seventh or so, where it looks like the beginning of a long packet.
  spoil(scout, GENERATE(0, 1) == 0 ? garbage_after(48, {0x5C, 0x01, 0x2C, 0x00})
                                   : garbage_after(331, {0x01, 0xC8, 0x00, 0x07}));
  check_goals(scout, device);
}
