// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of the RPLIDAR A1 with the laser's emulation at the other end of a pseudo terminal: nothing of it is simulated.
#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "rplidar_desk.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

TEST_CASE("an RPLIDAR's turns arrive as scans with the ranges that it saw, and it stops at the end",
          "[system][hardware]") {
  const auto [mode, said, request, step] = GENERATE(
      table<std::string, std::string, int, double>({{"auto", "it sends express scans", 0x82, 0.001},
                                                    {"express", "it sends express scans", 0x82, 0.001},
                                                    {"standard", "it sends standard scans", 0x20, 0.00025}}));
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  const Run run = run_deployer(listen(device, recorded(folder, {"--set", "mode=" + mode, "--until", "5 s"})),
                               Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says(
      "connected to an RPLIDAR, model 24, firmware 1.29, serial number A4E19AF0C1E39ED4B1984C951C284213"));
  CHECK(run.says(said));
  CHECK(was_asked(laser, request));
  const auto scans = scans_in(folder);
  REQUIRE(scans.size() > 10);
  check_ranges(scans.back(), step);
  CHECK(number(scans.back(), "pose.x") == 0.1);
  CHECK(number(scans.back(), "pose.y") == -0.02);
  CHECK(number(scans.back(), "pose.z") == 0.3);
  CHECK(number(scans.back(), "pose.rotation.yaw") == Approx(90.0 * kDegree));
  CHECK(number(scans.back(), "min_range") == 0.15);
  CHECK(number(scans.back(), "max_range") == 12.0);
  CHECK_FALSE(sends(laser));
  CHECK(requests_to(laser).back() == 0x25);  // stop
}

TEST_CASE("a scan has the time at which its turn began, and tells how long the turn took",
          "[system][hardware][quiet]") {
  const auto mode = GENERATE(as<std::string>{}, "standard", "express");
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  const Run run = run_deployer(listen(device, recorded(folder, {"--set", "mode=" + mode, "--until", "6 s"})),
                               Seconds(60));
  INFO(run.err);
  const auto scans = scans_in(folder);
  REQUIRE(scans.size() > 10);
  const RecordTable::Row& first = scans[1];
  const RecordTable::Row& last = scans.back();
  const auto turns = static_cast<double>(scans.size() - 2);
  CHECK(number(last, "stamp") - number(first, "stamp") == Approx(turns / 5.5).margin(0.03));
  CHECK(360.0 * number(last, "time_increment") == Approx(1.0 / 5.5).margin(0.03));
  // A turn, and what its last point and the line need.
  CHECK(number(last, "creation_time") - number(last, "stamp") > 1.0 / 5.5 - 0.03);
}

TEST_CASE("what is beyond the range that is believed is nothing, and the number of beams can be chosen",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  const Run run = run_deployer(
      listen(device, recorded(folder, {"--set", "beams=720", "--set", "max_range=6 m", "--until", "5 s"})),
      Seconds(60));
  INFO(run.err);
  const auto scans = scans_in(folder);
  REQUIRE(scans.size() > 5);
  const std::vector<double> ranges = numbers(scans.back(), "ranges");
  REQUIRE(ranges.size() == 720);
  CHECK(ranges[360] == Approx(1.0).margin(0.03));  // ahead
  CHECK(ranges[540] == kInfinity);                 // 7.75 m to the right
}

TEST_CASE("an RPLIDAR whose firmware knows no express scans is asked for standard ones",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  RplidarSettings settings = at_once();
  settings.has_express = false;
  Laser laser(device, settings);
  show_place(laser);
  const Run run = run_deployer(listen(device, recorded(folder, {"--until", "6 s"})), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("it sends standard scans"));
  CHECK(scans_in(folder).size() > 5);
}

TEST_CASE("an express scan that was asked for and cannot be had is a fault that names the way out",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  RplidarSettings settings = at_once();
  settings.has_express = false;
  Laser laser(device, settings);
  Subprocess program(deployer(listen(device, {"--set", "mode=express"})));
  CHECK(program.wait_for_output("write mode=\"standard\"", Seconds(20 * kSlowdown)));
}

TEST_CASE("an RPLIDAR that reports an error is reset once, and works if that has helped",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  laser.with([](BadRplidar& firmware, MirrorOnDesk&) { firmware.device().set_health(2, 0x8001); });
  Subprocess program(deployer(listen(device)));
  CHECK(eventually([&] { return turns_sent(laser) > 3; }));
  const std::vector<int> requests = requests_to(laser);
  CHECK(std::ranges::count(requests, 0x40) == 1);
}

TEST_CASE("an RPLIDAR whose error stays does not start, and what to do is said", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  RplidarSettings settings = at_once();
  settings.resets_heal = false;
  Laser laser(device, settings);
  laser.with([](BadRplidar& firmware, MirrorOnDesk&) { firmware.device().set_health(2, 0x8001); });
  const Run run = run_deployer(listen(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains("reports error 8001 and still does after a reset") &&
                          Contains("Let its head turn freely"));
}

TEST_CASE("an RPLIDAR that may fail soon works, with a warning", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  laser.with([](BadRplidar& firmware, MirrorOnDesk&) { firmware.device().set_health(1, 7); });
  Subprocess program(deployer(listen(device)));
  CHECK(program.wait_for_output("it may fail soon (number 7)", Seconds(20 * kSlowdown)));
  CHECK(eventually([&] { return turns_sent(laser) > 3; }));
}

TEST_CASE("an RPLIDAR whose motor stands is a fault that names motor, supply and DTR", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  Laser laser(device, at_once());
  show_place(laser);
  const auto power = [&](bool on) {
    laser.with(
        [on](BadRplidar& firmware, MirrorOnDesk&) { firmware.device().power_motor(on, steady_now()); });
  };
  power(false);
  Subprocess program(deployer(listen(device)));
  REQUIRE(program.wait_for_output("is told to scan and sends no points: does its head turn?",
                                  Seconds(20 * kSlowdown)));
  power(true);
  CHECK(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  CHECK(eventually([&] { return turns_sent(laser) > 3; }));
}

TEST_CASE("an RPLIDAR that sees nothing at all says so once", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  RplidarSettings settings = at_once();
  settings.turn = 60ms;
  Laser laser(device, settings);
  Subprocess program(deployer(listen(device)));
  REQUIRE(program.wait_for_output("has seen nothing for 50 turns", Seconds(20 * kSlowdown)));
  const int before = turns_sent(laser);
  CHECK(eventually([&] { return turns_sent(laser) > before + 60; }));
  const std::string text = program.err();
  CHECK(text.find("seen nothing") == text.rfind("seen nothing"));
}
