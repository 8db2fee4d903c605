// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of the RPLIDAR A1 on lines that spoil, hold back, echo and break, and with a laser that starts anew.
#include <catch2/catch.hpp>

#include <csignal>
#include <functional>
#include <string>
#include <vector>

#include "orca/base/steady_clock.hpp"
#include "rplidar_desk.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

namespace {

void spoil(Laser& laser, const std::function<void(std::vector<std::uint8_t>&)>& change) {
  laser.with([&](BadRplidar& line, MirrorOnDesk&) { line.spoil(change); });
}

/// What a driver made of a line that was spoiled from the beginning.
struct SpoiledRun {
  SpoiledRun(const std::string& mode, const std::function<void(std::vector<std::uint8_t>&)>& change) {
    const std::string device = folder.file("lidar");
    Laser laser(device, at_once());
    show_place(laser);
    spoil(laser, change);
    run = run_deployer(listen(device, recorded(folder, {"--set", "mode=" + mode, "--until", "8 s"})),
                       Seconds(90));
  }
  // @param beside  beams: points that are lost leave a gap, which is filled from its edges.
  void check_scans(std::size_t least, int beside = 1) {
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    const auto scans = scans_in(folder);
    REQUIRE(scans.size() >= least);
    for (const RecordTable::Row& scan : scans) check_ranges(scan, 0.001, beside);
  }
  TempFolder folder;
  Run run;
};

// Returns what cuts a byte out at random with that chance [0..1].
std::function<void(std::vector<std::uint8_t>&)> lost_bytes(double chance) {
  return [chance, random = RandomStream(1, "test", "lost bytes")](std::vector<std::uint8_t>& sent) mutable {
    std::erase_if(sent, [&](std::uint8_t) { return random.uniform(0.0, 1.0) < chance; });
  };
}

}  // namespace

TEST_CASE("scans of capsules of which one in a hundred is spoiled still arrive, and none is wrong",
          "[system][hardware]") {
  // A capsule has 84 bytes; a checksum of one byte that is the exclusive or lets no single flip through.
  SpoiledRun spoiled("express", flipped_bits(0.01 / 84.0));
  spoiled.check_scans(15);
}

TEST_CASE("scans arrive, and none is wrong, though bytes of them are lost", "[system][hardware]") {
  const auto mode = GENERATE(as<std::string>{}, "standard", "express");
  SpoiledRun spoiled(mode, lost_bytes(0.0001));
  spoiled.check_scans(12, mode == "standard" ? 7 : 1);
}

TEST_CASE("garbage inside a scan of capsules costs the turns that it hits, and no more",
          "[system][hardware]") {
  // A piece every 20000 bytes, which are 1.9 s.
  SpoiledRun spoiled("express", garbage_after(20000, {0xA5, 0x5A, 0x05, 0xA6, 0x57, 0xFF}));
  spoiled.check_scans(15);
}

TEST_CASE("the pieces in which a scan comes do not matter", "[system][hardware]") {
  const auto mode = GENERATE(as<std::string>{}, "standard", "express");
  SpoiledRun spoiled(mode, glued(20));  // 20 ms at once
  spoiled.check_scans(20);
}

TEST_CASE("a scan that comes byte by byte is a scan", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  hw::link::FaultPlan plan;
  plan.modes.byte_by_byte = true;
  Laser laser(DeskLine(device, plan), at_once());
  show_place(laser);
  const Run run = run_deployer(listen(device, recorded(folder, {"--until", "5 s"})), Seconds(60));
  INFO(run.err);
  const auto scans = scans_in(folder);
  REQUIRE(scans.size() > 10);
  check_ranges(scans.back(), 0.001);
}

TEST_CASE("an RPLIDAR of which nothing comes whole any more is a fault, and works when the line does",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  Subprocess program(deployer(listen(device)));
  REQUIRE(eventually([&] { return turns_sent(laser) > 3; }));
  spoil(laser, all_spoiled());
  REQUIRE(program.wait_for_output("nothing has come from it for 1 s", Seconds(20 * kSlowdown)));
  spoil(laser, {});
  REQUIRE(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  const int before = turns_sent(laser);
  CHECK(eventually([&] { return turns_sent(laser) > before + 3; }));
}

TEST_CASE("when every answer is spoiled nothing starts, and other devices and rates are thought of",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  spoil(laser, flipped_bits(1.0));
  const Run run = run_deployer(listen(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains("bytes come from serial:" + device +
                               " at 115200 baud, but no answer of an RPLIDAR A1"));
}

TEST_CASE("an RPLIDAR of another rate is not found, and its rate is thought of", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  RplidarSettings settings = at_once();
  settings.baud = 256000;
  Laser laser(device, settings);
  const Run run = run_deployer(listen(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains("no RPLIDAR answers at serial:" + device + " at 115200 baud") ||
                          Contains("An A3 or S1 has 256000 baud"));
}

TEST_CASE("without an RPLIDAR on the line nothing starts, and what to look at is said",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  laser.fall_silent(true);
  const Run run = run_deployer(listen(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains("no RPLIDAR answers at serial:" + device +
                               " at 115200 baud; is it plugged in, does its green lamp shine"));
}

TEST_CASE("a line that only sends back what it is sent is not taken for an RPLIDAR", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  RplidarSettings settings;
  settings.boot = 1h;
  Laser laser(device, settings);
  laser.echo(true);
  const Run run = run_deployer(listen(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK(run.says("Does the cable only echo what it is sent?"));
}

TEST_CASE("an adapter that echoes what is sent does not disturb an RPLIDAR", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  laser.echo(true);
  const Run run = run_deployer(listen(device, recorded(folder, {"--until", "5 s"})), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const auto scans = scans_in(folder);
  REQUIRE(scans.size() > 10);
  check_ranges(scans.back(), 0.001);
}

TEST_CASE("an RPLIDAR that falls silent is a fault, and works when it is heard again", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  Subprocess program(deployer(listen(device)));
  REQUIRE(eventually([&] { return turns_sent(laser) > 3; }));
  laser.fall_silent(true);
  REQUIRE(program.wait_for_output("nothing has come from it for 1 s", Seconds(20 * kSlowdown)));
  laser.fall_silent(false);
  CHECK(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
}

TEST_CASE("an RPLIDAR that is unplugged while it scans comes back", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  Subprocess program(deployer(listen(device)));
  REQUIRE(eventually([&] { return turns_sent(laser) > 3; }));
  laser.unplug();
  CHECK(program.wait_for_output("the device has gone: was it unplugged or switched off?",
                                Seconds(20 * kSlowdown)));
  laser.plug_in();
  REQUIRE(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  const int before = turns_sent(laser);
  CHECK(eventually([&] { return turns_sent(laser) > before + 3; }));
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
  CHECK_FALSE(sends(laser));
}

TEST_CASE("an RPLIDAR whose power was interrupted while it scans is found and started again",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  RplidarSettings settings = at_once();
  settings.boot = 300ms;
  Laser laser(device, settings);
  show_place(laser);
  Subprocess program(deployer(listen(device)));
  REQUIRE(eventually([&] { return turns_sent(laser) > 3; }));
  laser.with([](BadRplidar& line, MirrorOnDesk&) { line.reset(steady_now()); });
  CHECK_FALSE(sends(laser));
  REQUIRE(program.wait_for_output("is it still connected and switched on?", Seconds(20 * kSlowdown)));
  REQUIRE(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  const int before = turns_sent(laser);
  CHECK(eventually([&] { return turns_sent(laser) > before + 3; }));
}

TEST_CASE("an RPLIDAR that still scans from an earlier run is stopped first, and started",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  {
    Subprocess killed(deployer(listen(device, {"--in-process"})));
    REQUIRE(eventually([&] { return turns_sent(laser) > 3; }));
    killed.send(SIGKILL);
    REQUIRE(killed.wait(Seconds(10)));
  }
  CHECK(sends(laser));
  const Run run = run_deployer(listen(device, recorded(folder, {"--until", "5 s", "--set", "mode=standard"})),
                               Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const auto scans = scans_in(folder);
  REQUIRE(scans.size() > 5);
  check_ranges(scans.back(), 0.00025);
}
