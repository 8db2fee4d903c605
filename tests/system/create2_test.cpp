// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of the Create 2 with the controller's emulation at the other end of a pseudo terminal.
#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>
#include <string>
#include <thread>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/create2_firmware.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::Create2Firmware;
using emulators::Create2Mode;
using emulators::Create2Settings;

namespace {

using BadCreate = BadLine<Create2Firmware>;
using Create = DeviceOnDesk<BadCreate, PlainBody>;

constexpr int kStart = 128;  // leads to passive mode, in which the wheels stand
constexpr int kSafe = 131;
constexpr int kDriveDirect = 145;

Words drive(const std::string& device, const Words& more = {}) {
  return Words{system_graph("create2.xml"), "--set", "device=" + device} + more;
}

Words far_goal() { return {"--set", "goals=far: 30 0"}; }

Twist2 velocity(Create& create) {
  return create.with([](BadCreate&, PlainBody& body) { return body.velocity(); });
}
bool is_moving(Create& create) { return velocity(create).forward > 0.1; }
bool stands(Create& create) { return velocity(create) == Twist2{}; }
Create2Mode mode(Create& create) {
  return create.with([](BadCreate& line, PlainBody&) { return line.device().mode(); });
}
Pose2 pose(Create& create) {
  return create.with([](BadCreate&, PlainBody& body) { return body.odometry(); });
}
std::vector<int> commands(Create& create) {
  return create.with([](BadCreate& line, PlainBody&) { return line.device().commands(); });
}

// Drives to the goals of the graph, and checks that the robot got there.
void check_goals(Create& create, const std::string& device) {
  const Run run = run_deployer(drive(device), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 2);
  const Pose2 end = pose(create);
  CHECK(std::hypot(end.x - run.arrivals()[1].x, end.y - run.arrivals()[1].y) < 0.1);
  CHECK(stands(create));
}

// Waits until the robot moves.
void set_off(Create& create) {
  REQUIRE(eventually([&] { return is_moving(create); }));
}

void check_release(Create& create) {
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return is_moving(create); }));
}

}  // namespace

TEST_CASE("a Create 2 drives to its goals over a serial line, and its interface is off before and after",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create create(device);
  check_goals(create, device);
  CHECK(mode(create) == Create2Mode::off);
  const std::vector<int> all = commands(create);
  const auto safe = std::ranges::find(all, kSafe);
  REQUIRE(safe != all.end());
  CHECK(std::ranges::find(all, kDriveDirect) - safe == 1);  // safe mode comes with the first command to move
}

TEST_CASE("the rate of a Create 2 that was started with 19200 baud is found", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create2Settings settings;
  settings.baud = 19200;
  Create create(device, settings);
  const Run run = run_deployer(drive(device), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("connected to a Create 2 at 19200 baud"));
}

TEST_CASE("a Roomba whose firmware reports its mode plus one drives to its goals", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create2Settings settings;
  settings.mode_offset = 1;
  Create create(device, settings);
  check_goals(create, device);
}

TEST_CASE("without a Create 2 on the line nothing starts, and what to look at is said",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create create(device);
  create.fall_silent(true);
  const Run run = run_deployer(drive(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains("no Create 2 answers at serial:" + device +
                               " at 115200, 19200 baud; press its Clean button"));
}

TEST_CASE("a Create 2 that is unplugged drives on, is stopped when it is back, and stands until it is let go",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create create(device);
  Subprocess program(deployer(drive(device, far_goal())));
  set_off(create);
  create.unplug();
  CHECK(program.wait_for_output("the device has gone: was it unplugged or switched off?",
                                Seconds(20 * kSlowdown)));
  CHECK_FALSE(stands(create));  // it has no watchdog
  create.plug_in();
  const bool back = program.wait_for_output("it works again", Seconds(30));
  INFO(program.err());
  REQUIRE(back);
  CHECK(stands(create));
  std::this_thread::sleep_for(500ms);
  CHECK(stands(create));
  CHECK(mode(create) == Create2Mode::passive);
  check_release(create);
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
}

TEST_CASE(
    "kill -9 of the whole system: a Create 2 drives on, for it has no watchdog, and the next start stops it "
    "first",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create create(device);
  Subprocess program(deployer(drive(device, far_goal() + Words{"--in-process"})));
  set_off(create);
  program.send(SIGKILL);
  std::this_thread::sleep_for(1s);
  CHECK(is_moving(create));
  const std::size_t before = commands(create).size();
  const Run run = run_deployer(drive(device, {"--set", "goals=here: 0 0"}), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(commands(create).size() > before);
  CHECK(commands(create)[before] == kStart);
  CHECK(stands(create));
}

TEST_CASE("a Create 2 that is switched off and on in mid-motion is found again, and stands",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create create(device);
  Subprocess program(deployer(drive(device, far_goal())));
  set_off(create);
  create.with([](BadCreate& line, PlainBody&) { line.reset(steady_now()); });
  CHECK(program.wait_for_output("is it still connected and switched on?", Seconds(20 * kSlowdown)));
  REQUIRE(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  std::this_thread::sleep_for(500ms);
  CHECK(stands(create));
  CHECK(mode(create) == Create2Mode::passive);
  check_release(create);
}

TEST_CASE("a Create 2 that bumps into something stands, and does not drive on towards it",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create create(device);
  Subprocess program(deployer(drive(device, far_goal())));
  set_off(create);
  create.with([](BadCreate&, PlainBody& body) { body.touch(1); });
  REQUIRE(eventually([&] { return stands(create); }));
  const double there = pose(create).x;
  std::this_thread::sleep_for(1s);
  CHECK(pose(create).x - there < 0.01);
}

TEST_CASE("a Create 2 stops at a cliff, and is not driven on over it", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create create(device);
  Subprocess program(deployer(drive(device, far_goal())));
  set_off(create);
  create.with([](BadCreate&, PlainBody& body) { body.drop(2); });
  REQUIRE(eventually([&] { return stands(create); }));
  const double there = pose(create).x;
  std::this_thread::sleep_for(1s);
  CHECK(pose(create).x - there < 0.01);
  CHECK(mode(create) == Create2Mode::passive);
  CHECK(create.with([](BadCreate& line, PlainBody&) { return line.device().safety_stops(); }) == 1);
}

TEST_CASE("a Create 2 that is lifted up or connected to its charger stands until it is let go",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create create(device);
  Subprocess program(deployer(drive(device, far_goal())));
  set_off(create);
  const bool is_lift = GENERATE(true, false);
  const auto disturb = [&](bool on) {
    create.with([&](BadCreate& line, PlainBody& body) {
      if (is_lift)
        body.lift(on);
      else
        line.device().connect_charger(on);
    });
  };
  disturb(true);
  CHECK(program.wait_for_output(is_lift ? "a wheel hangs; put it down" : "it is connected to its charger",
                                Seconds(20 * kSlowdown)));
  CHECK(eventually([&] { return stands(create); }));
  disturb(false);
  std::this_thread::sleep_for(500ms);
  CHECK(stands(create));
  CHECK(mode(create) == Create2Mode::passive);
  check_release(create);
}

TEST_CASE("a Create 2 that is held is told to stop, although it would drive on by itself",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("create");
  Create2Settings settings;
  settings.heeds_charger = false;
  Create create(device, settings);
  Subprocess program(deployer(drive(device, far_goal())));
  set_off(create);
  create.with([](BadCreate& line, PlainBody&) { line.device().connect_charger(true); });
  CHECK(program.wait_for_output("alarm ESTOP: the base is held: it is connected to its charger",
                                Seconds(20 * kSlowdown)));
  CHECK(eventually([&] { return stands(create); }));
  CHECK(mode(create) == Create2Mode::safe);
}
