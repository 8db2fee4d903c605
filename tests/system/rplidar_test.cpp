// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of the RPLIDAR A1 with the laser's emulation at the other end of a line in memory, in virtual time; two cases at the end have a
// pseudo terminal and real time.
#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "record_table.hpp"
#include "temp_folder.hpp"
#include "virtual_desk.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::RplidarFirmware;
using emulators::RplidarSettings;
using Rows = std::vector<RecordTable::Row>;

namespace {

using BadRplidar = BadLine<RplidarFirmware>;
using Change = std::function<void(std::vector<std::uint8_t>&)>;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RplidarSettings at_once() {
  RplidarSettings settings;
  settings.boot = 0s;
  settings.spin_up = 100ms;
  return settings;
}

// A range of its own for each degree to the left of straight ahead, and no echo between 40 and 60 degrees.
std::vector<double> ranges_of_place() {
  std::vector<double> ranges;
  for (int i = 0; i < 360; ++i) ranges.push_back(i >= 40 && i <= 60 ? kInfinity : 1.0 + 0.025 * i);
  return ranges;
}

// A laser on a desk that sees that place, and whose line a test can spoil.
template <template <class, class> class Desk>
struct LaserOn : Desk<BadRplidar, MirrorOnDesk> {
  explicit LaserOn(const DeskLine& line, const RplidarSettings& settings = at_once())
      : Desk<BadRplidar, MirrorOnDesk>(line, settings) {
    this->with([](BadRplidar&, MirrorOnDesk& mirror) { mirror.show(0.0, kDegree, ranges_of_place()); });
  }
  template <class Look>
  auto look(Look at) {
    return this->with([&](BadRplidar& line, MirrorOnDesk&) { return at(line.device()); });
  }
  void spoil(const Change& change) {
    this->with([&](BadRplidar& line, MirrorOnDesk&) { line.spoil(change); });
  }
  bool sends() {
    return look([](RplidarFirmware& laser) { return laser.sends_scans(); });
  }
  int turns() {
    return look([](RplidarFirmware& laser) { return laser.turns(); });
  }
  std::vector<int> requests() {
    return look([](RplidarFirmware& laser) { return laser.requests(); });
  }
  bool was_asked(int request) { return std::ranges::count(requests(), request) > 0; }
};

struct Laser : LaserOn<VirtualDevice> {
  explicit Laser(const RplidarSettings& settings = at_once()) : LaserOn("lidar", settings) {}
  bool goes_on() {
    return bench().until([this, before = turns()] { return turns() > before + 3; });
  }
};
using LaserInRealTime = LaserOn<DeviceOnDesk>;

Words listen(const std::string& device, const Words& more = {}) {
  return Words{system_graph("rplidar.xml"), "--set", "device=" + device} + more;
}
Words recorded(const TempFolder& folder, const Words& more = {}) {
  return Words{"--record", folder.file("scans.csv") + "=laser.LaserRangeReadingsPush"} + more;
}
Rows scans_in(const TempFolder& folder) {
  return RecordTable(folder.file("scans.csv")).rows("laser.LaserRangeReadingsPush");
}

// Drives the laser in memory.
Run run(const Words& more = {}, const std::function<void()>& script = {}) {
  return run_virtual(listen("memory:lidar", more), script);
}
// Does so, and returns the scans.
Rows scans_of_run(const Words& more) {
  const TempFolder folder;
  const Run ended = run(recorded(folder, more));
  INFO(ended.err);
  CHECK(ended.exit_code() == 0);
  return scans_in(folder);
}

// Checks that each beam of the scan shows what the mirror shows at most so many beams beside its direction.
void check_ranges(const RecordTable::Row& scan, double step, int beside = 1) {
  const std::vector<double> shown = ranges_of_place();
  const std::vector<double> got = numbers(scan, "ranges");
  REQUIRE(got.size() == 360);
  CHECK(number(scan, "angle_start") == Approx(std::numbers::pi));
  CHECK(number(scan, "angle_increment") == Approx(-kDegree));
  for (int i = 0; i < 360; ++i) {
    const int left = (540 - i) % 360;  // [deg] of the beam, counter-clockwise
    double nearest = kInfinity;
    double farthest = 0.0;
    for (int off = -beside; off <= beside; ++off) {
      const double range = shown[static_cast<std::size_t>((left + off + 360) % 360)];
      nearest = std::min(nearest, range);
      farthest = std::max(farthest, range);
    }
    const double range = got[static_cast<std::size_t>(i)];
    CAPTURE(i, left, range);
    CHECK(range >= nearest - 0.51 * step);
    CHECK(range <= farthest + 0.51 * step);
  }
}

// Returns what cuts a byte out at random with that chance [0..1].
Change lost_bytes(double chance) {
  return [chance, random = RandomStream(1, "test", "lost bytes")](std::vector<std::uint8_t>& sent) mutable {
    std::erase_if(sent, [&](std::uint8_t) { return random.uniform(0.0, 1.0) < chance; });
  };
}

}  // namespace

TEST_CASE("a scan has the time at which its turn began, and tells how long the turn took",
          "[system][hardware]") {
  const auto mode = GENERATE(as<std::string>{}, "standard", "express");
  Laser laser;
  const Rows scans = scans_of_run({"--set", "mode=" + mode, "--until", "6 s"});
  REQUIRE(scans.size() > 20);
  const RecordTable::Row& first = scans[1];
  const RecordTable::Row& last = scans.back();
  const auto turns = static_cast<double>(scans.size() - 2);
  CHECK(number(last, "stamp") - number(first, "stamp") == Approx(turns / 5.5).margin(0.01));
  CHECK(360.0 * number(last, "time_increment") == Approx(1.0 / 5.5).margin(0.005));
  // A turn, and what its last point and the line need.
  CHECK(number(last, "creation_time") - number(last, "stamp") > 1.0 / 5.5 - 0.005);
}

TEST_CASE("what is beyond the range that is believed is nothing, and the number of beams can be chosen",
          "[system][hardware]") {
  Laser laser;
  const Rows scans = scans_of_run({"--set", "beams=720", "--set", "max_range=6 m", "--until", "5 s"});
  REQUIRE(scans.size() > 5);
  const std::vector<double> ranges = numbers(scans.back(), "ranges");
  REQUIRE(ranges.size() == 720);
  CHECK(ranges[360] == Approx(1.0).margin(0.03));  // ahead
  CHECK(ranges[540] == kInfinity);                 // 7.75 m to the right
}

TEST_CASE("an RPLIDAR whose firmware knows no express scans is asked for standard ones",
          "[system][hardware]") {
  RplidarSettings settings = at_once();
  settings.has_express = false;
  Laser laser(settings);
  const TempFolder folder;
  const Run ended = run(recorded(folder, {"--until", "6 s"}));
  CHECK(ended.exit_code() == 0);
  CHECK(ended.says("it sends standard scans"));
  CHECK(scans_in(folder).size() > 5);
}

TEST_CASE("an express scan that was asked for and cannot be had is a fault that names the way out",
          "[system][hardware]") {
  RplidarSettings settings = at_once();
  settings.has_express = false;
  Laser laser(settings);
  CHECK(run({"--set", "mode=express", "--until", "20 s"}).says("write mode=\"standard\""));
}

TEST_CASE("an RPLIDAR that reports an error is reset once, and works if that has helped",
          "[system][hardware]") {
  Laser laser;
  laser.look([](RplidarFirmware& firmware) { firmware.set_health(2, 0x8001); });
  (void)run({}, [&] { CHECK(laser.goes_on()); });
  CHECK(std::ranges::count(laser.requests(), 0x40) == 1);
}

TEST_CASE("an RPLIDAR whose error stays does not start, and what to do is said", "[system][hardware]") {
  RplidarSettings settings = at_once();
  settings.resets_heal = false;
  Laser laser(settings);
  laser.look([](RplidarFirmware& firmware) { firmware.set_health(2, 0x8001); });
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err, Contains("reports error 8001 and still does after a reset") &&
                            Contains("Let its head turn freely"));
}

TEST_CASE("an RPLIDAR that may fail soon works, with a warning", "[system][hardware]") {
  Laser laser;
  laser.look([](RplidarFirmware& firmware) { firmware.set_health(1, 7); });
  const Run ended = run({}, [&] { CHECK(laser.goes_on()); });
  CHECK(ended.says("it may fail soon (number 7)"));
}

TEST_CASE("an RPLIDAR whose motor stands is a fault that names motor, supply and DTR", "[system][hardware]") {
  Laser laser;
  const auto power = [&](bool on) {
    laser.look([&](RplidarFirmware& firmware) { firmware.power_motor(on, laser.now()); });
  };
  power(false);
  (void)run({}, [&] {
    REQUIRE(bench().until_log("is told to scan and sends no points: does its head turn?"));
    power(true);
    CHECK(bench().until_log("it works again", 30s));
    CHECK(laser.goes_on());
  });
}

TEST_CASE("an RPLIDAR that sees nothing at all says so once", "[system][hardware]") {
  RplidarSettings settings = at_once();
  settings.turn = 60ms;
  Laser laser(settings);
  laser.with([](BadRplidar&, MirrorOnDesk& mirror) { mirror = {}; });
  const Run ended = run({}, [&] {
    REQUIRE(bench().until_log("has seen nothing for 50 turns"));
    const int before = laser.turns();
    CHECK(bench().until([&] { return laser.turns() > before + 60; }));
  });
  CHECK(ended.err.find("seen nothing") == ended.err.rfind("seen nothing"));
}

TEST_CASE("scans still arrive over a line that spoils them, and none is wrong", "[system][hardware]") {
  struct Case {
    std::string mode;
    Change change;
    std::size_t least;
    int beside = 1;  // beams: points that are lost leave a gap, which is filled from its edges
  };
  const Case given = GENERATE(values<Case>({
      // One capsule in a hundred: it has 84 bytes, and a checksum of one byte that is the exclusive or lets no single flip through.
      {"express", flipped_bits(0.01 / 84.0), 15},
      {"standard", lost_bytes(0.0001), 12, 7},
      {"express", lost_bytes(0.0001), 12},
      // A piece every 20000 bytes, which are 1.9 s, costs the turns that it hits, and no more.
      {"express", garbage_after(20000, {0xA5, 0x5A, 0x05, 0xA6, 0x57, 0xFF}), 15},
      {"standard", glued(20), 20},  // 20 ms at once
      {"express", glued(20), 20},
  }));
  Laser laser;
  laser.spoil(given.change);
  const Rows scans = scans_of_run({"--set", "mode=" + given.mode, "--until", "8 s"});
  CAPTURE(given.mode);
  REQUIRE(scans.size() >= given.least);
  for (const RecordTable::Row& scan : scans) check_ranges(scan, 0.001, given.beside);
}

TEST_CASE("a scan that comes byte by byte is a scan", "[system][hardware]") {
  hw::link::FaultPlan plan;
  plan.modes.byte_by_byte = true;
  LaserOn<VirtualDevice> laser(DeskLine("lidar", plan));
  const Rows scans = scans_of_run({"--until", "5 s"});
  REQUIRE(scans.size() > 10);
  check_ranges(scans.back(), 0.001);
}

TEST_CASE("an RPLIDAR of which nothing comes whole, or at all, is a fault, and works when the line does",
          "[system][hardware]") {
  Laser laser;
  const bool falls_silent = GENERATE(false, true);
  (void)run({}, [&] {
    REQUIRE(laser.goes_on());
    falls_silent ? laser.fall_silent(true) : laser.spoil(all_spoiled());
    REQUIRE(bench().until_log("nothing has come from it for 1 s"));
    falls_silent ? laser.fall_silent(false) : laser.spoil({});
    REQUIRE(bench().until_log("it works again", 30s));
    CHECK(laser.goes_on());
  });
}

TEST_CASE("when every answer is spoiled nothing starts, and other devices and rates are thought of",
          "[system][hardware]") {
  Laser laser;
  laser.spoil(flipped_bits(1.0));
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err,
             Contains("bytes come from memory:lidar at 115200 baud, but no answer of an RPLIDAR A1"));
}

TEST_CASE("an RPLIDAR of another rate is not found, and its rate is thought of", "[system][hardware]") {
  RplidarSettings settings = at_once();
  settings.baud = 256000;
  Laser laser(settings);
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err,
             Contains("bytes come from memory:lidar at 115200 baud, but no answer of an RPLIDAR A1") &&
                 Contains("An A3 or S1 has 256000 baud"));
}

TEST_CASE("without an RPLIDAR on the line nothing starts, and what to look at is said",
          "[system][hardware]") {
  Laser laser;
  laser.fall_silent(true);
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err, Contains("no RPLIDAR answers at memory:lidar at 115200 baud; is it plugged in, does "
                                 "its green lamp shine"));
}

TEST_CASE("a line that only sends back what it is sent is not taken for an RPLIDAR", "[system][hardware]") {
  RplidarSettings settings;
  settings.boot = 1h;
  Laser laser(settings);
  laser.echo(true);
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK(ended.says("Does the cable only echo what it is sent?"));
}

TEST_CASE("an adapter that echoes what is sent does not disturb an RPLIDAR", "[system][hardware]") {
  Laser laser;
  laser.echo(true);
  const Rows scans = scans_of_run({"--until", "5 s"});
  REQUIRE(scans.size() > 10);
  check_ranges(scans.back(), 0.001);
}

TEST_CASE("an RPLIDAR whose power was interrupted while it scans is found and started again",
          "[system][hardware]") {
  RplidarSettings settings = at_once();
  settings.boot = 300ms;
  Laser laser(settings);
  (void)run({}, [&] {
    REQUIRE(laser.goes_on());
    laser.with([&](BadRplidar& line, MirrorOnDesk&) { line.reset(laser.now()); });
    CHECK_FALSE(laser.sends());
    REQUIRE(bench().until_log("is it still connected and switched on?"));
    REQUIRE(bench().until_log("it works again", 30s));
    CHECK(laser.goes_on());
  });
}

TEST_CASE("an RPLIDAR that still scans from an earlier run is stopped first, and started",
          "[system][hardware]") {
  Laser laser;
  (void)run({}, [&] {
    REQUIRE(laser.goes_on());
    laser.unplug();  // so it is never told to stop
  });
  laser.plug_in();
  CHECK(laser.sends());
  const Rows scans = scans_of_run({"--until", "5 s", "--set", "mode=standard"});
  REQUIRE(scans.size() > 5);
  check_ranges(scans.back(), 0.00025);
}

TEST_CASE("each kind of scan can be chosen, and is the laser's own when it arrives", "[system][hardware]") {
  const auto [mode, said, request, step] = GENERATE(
      table<std::string, std::string, int, double>({{"auto", "it sends express scans", 0x82, 0.001},
                                                    {"express", "it sends express scans", 0x82, 0.001},
                                                    {"standard", "it sends standard scans", 0x20, 0.00025}}));
  Laser laser;
  const TempFolder folder;
  const Run ended = run(recorded(folder, {"--set", "mode=" + mode, "--until", "5 s"}));
  INFO(ended.err);
  CHECK(ended.exit_code() == 0);
  CHECK(ended.says(said));
  CHECK(laser.was_asked(request));
  const Rows scans = scans_in(folder);
  REQUIRE(scans.size() > 10);
  check_ranges(scans.back(), step);
  CHECK(laser.requests().back() == 0x25);  // stop
}

TEST_CASE("an RPLIDAR's turns arrive as scans with the ranges that it saw, and it stops at the end",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  LaserInRealTime laser(device);
  const Run ended = run_deployer(listen(device, recorded(folder, {"--until", "5 s"})), Seconds(60));
  INFO(ended.err);
  CHECK(ended.exit_code() == 0);
  CHECK(ended.says(
      "connected to an RPLIDAR, model 24, firmware 1.29, serial number A4E19AF0C1E39ED4B1984C951C284213"));
  const Rows scans = scans_in(folder);
  REQUIRE(scans.size() > 10);
  check_ranges(scans.back(), 0.001);
  CHECK(number(scans.back(), "pose.x") == 0.1);
  CHECK(number(scans.back(), "pose.y") == -0.02);
  CHECK(number(scans.back(), "pose.z") == 0.3);
  CHECK(number(scans.back(), "pose.rotation.yaw") == Approx(90.0 * kDegree));
  CHECK(number(scans.back(), "min_range") == 0.15);
  CHECK(number(scans.back(), "max_range") == 12.0);
  CHECK(eventually([&] { return !laser.sends(); }));  // it may not have read its line yet
  CHECK(laser.requests().back() == 0x25);             // stop
}

TEST_CASE("an RPLIDAR that is unplugged while it scans comes back", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  LaserInRealTime laser(device);
  Subprocess program(deployer(listen(device)));
  const auto goes_on = [&] {
    return eventually([&, before = laser.turns()] { return laser.turns() > before + 3; });
  };
  REQUIRE(goes_on());
  laser.unplug();
  CHECK(program.wait_for_output("the device has gone: was it unplugged or switched off?",
                                Seconds(20 * kSlowdown)));
  laser.plug_in();
  REQUIRE(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  CHECK(goes_on());
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
  CHECK(eventually([&] { return !laser.sends(); }));  // it may not have read its line yet
}
