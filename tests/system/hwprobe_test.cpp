// SPDX-License-Identifier: GPL-3.0-or-later
// hwprobe with emulated devices on a pseudo terminal.
#include <catch2/catch.hpp>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/text/object_xml.hpp"
#include "ports.hpp"
#include "summary.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using orca::emulators::P2osFirmware;

namespace {

using Pioneer = DeviceOnDesk<P2osFirmware, PlainBody>;

Run probe(const Words& words) {
  Subprocess program(hwprobe(words));
  return finish(program, Seconds(60));
}

const Words kOnlyPioneers{"--driver", "orca.hw.P2os"};

}  // namespace

TEST_CASE("hwprobe names the robot at a port, shows its first data and counts, and leaves its motors off",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  const Run run = probe(Words{device} + kOnlyPioneers);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("orca.hw.P2os: ActivMedia Pioneer 2-DX"));
  CHECK_THAT(run.out, Contains("connected to \"Orca_Emu\" (Pioneer p2dx) at 38400 baud"));
  CHECK_THAT(run.out,
             Contains("Odometry: x 0, y 0") && Contains("SonarRangeReadings: ") && Contains("Battery: "));
  CHECK_THAT(run.out, Contains("0 spoiled, 0 bytes skipped"));
  CHECK_THAT(run.out, Contains("<param name=\"device\" value=\"" + device + "\"/>"));
  pioneer.with([](P2osFirmware& firmware, PlainBody&) {
    CHECK_FALSE(firmware.has_power());
    CHECK_FALSE(firmware.is_open());
    for (const int command : firmware.commands()) CHECK((command != 11 && command != 21));  // none to move
  });
}

TEST_CASE("hwprobe shows a whole ring of sonars, and looks at a robot as the model that it calls itself",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  orca::emulators::P2osSettings settings;
  settings.subclass = "p3dx";
  settings.range_unit = 0.001;
  Pioneer pioneer(device, settings);
  pioneer.with([](P2osFirmware&, PlainBody& body) { body.surround(1.25); });
  const Run run = probe(Words{device} + kOnlyPioneers);
  INFO(run.out);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("orca.hw.P2os: ActivMedia Pioneer 3-DX"));
  CHECK_THAT(run.out, Contains("<param name=\"model\" value=\"p3dx\"/></hardware>"));
  std::string ring = "ranges";
  for (int i = 0; i < 16; ++i) ring += " 1.25";
  CHECK_THAT(run.out, Contains(ring + "\n"));
}

TEST_CASE("hwprobe watches a device until it is told to stop, and leaves it well", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  Subprocess program(hwprobe(Words{device, "--watch"} + kOnlyPioneers));
  const auto shown = [&] {
    const std::string out = program.out();
    std::size_t count = 0;
    for (std::size_t at = out.find("Odometry: "); at != std::string::npos;
         at = out.find("Odometry: ", at + 1))
      ++count;
    return count;
  };
  REQUIRE(eventually([&] { return shown() >= 3; }));
  program.send(SIGINT);
  const Run run = finish(program, Seconds(10));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("orca.hw.P2os: ActivMedia Pioneer 2-DX"));
  CHECK_FALSE(pioneer.with([](P2osFirmware& firmware, PlainBody&) { return firmware.is_open(); }));
  CHECK(probe({"--watch"}).exit_code() == 2);
}

TEST_CASE("hwprobe finds the devices of the graph that has nothing else", "[system][hardware]") {
  Subprocess devices(deployer(
      {source_file("graphs/emulated_devices.xml"), "--set", "lines=p2os probe_robot; sick_lms probe_laser"}));
  REQUIRE(devices.wait_for_output("emulated:probe_laser, other programs as /", Seconds(20) * kSlowdown));
  const Run run = probe({"emulated:probe_robot", "emulated:probe_laser"});
  INFO(run.out);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("orca.hw.P2os: ActivMedia Pioneer 2-DX"));
  CHECK_THAT(run.out, Contains("orca.hw.SickLms: SICK LMS200"));
  const Run pose = run_orcactl({"echo", "truth.RobotPosePush", "--count", "1"});
  CHECK_THAT(pose.out, Contains("<RobotPose "));
}

TEST_CASE("what is shown of an object has no more digits than people read, and of a scan its extremes",
          "[system][hardware]") {
  std::string scan =
      R"(<LaserRangeReadings creation_time="0" origin="" origin_port="" seq="7" mission="0" ranges=")";
  for (int i = 0; i < 70; ++i) scan += i == 11 ? "-9.43000000001 " : i == 20 ? "inf " : "-8 ";
  scan += R"(" angle_start="-1.5707963"><pose/><part/><part/></LaserRangeReadings>)";
  CHECK(orca::hwprobe::summary(scan) ==
        std::vector<std::string>{"LaserRangeReadings: angle_start -1.571",
                                 "  ranges 70 values from -9.43 to -8, the smallest is number 12",
                                 "  part, 2 of them", "  pose"});
}

TEST_CASE("hwprobe finds an RPLIDAR with all drivers, shows its first turn and stops it",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lidar");
  DeviceOnDesk<orca::emulators::RplidarFirmware, MirrorOnDesk> laser(device);
  const Run run = probe({device});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("orca.hw.Rplidar: SLAMTEC RPLIDAR A1"));
  CHECK_THAT(run.out, Contains("LaserRangeReadings: "));
  CHECK_FALSE(laser.with([](auto& firmware, MirrorOnDesk&) { return firmware.sends_scans(); }));
}

TEST_CASE("hwprobe says why no driver has found its device", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  pioneer.fall_silent(true);
  const Run run = probe(Words{device} + kOnlyPioneers);
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.out, Contains("orca.hw.P2os: no Pioneer answers at serial:" + device + " at 9600, 38400"));
}

TEST_CASE("a driver of devices in the network is asked at a serial port only by name", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  pioneer.fall_silent(true);
  const Run all = probe({device, "--limit", "1"});
  CHECK_THAT(all.out,
             Contains("orca.hw.P2os: ") && Contains("orca.hw.SickLms: ") && !Contains("orca.hw.Player: "));
  const Run named = probe({device, "--limit", "3", "--driver", "orca.hw.Player"});
  CHECK_THAT(named.out, Contains("orca.hw.Player: "));
}

TEST_CASE("hwprobe says what is wrong with a port before any driver tries it", "[system][hardware]") {
  const TempFolder folder;
  const Run missing = probe({folder.file("nothing")});
  CHECK(missing.exit_code() == 1);
  CHECK_THAT(missing.out, Contains("nothing") && !Contains("orca.hw.P2os"));
  const Run file = probe({folder.write("file", "text")});
  CHECK(file.exit_code() == 1);
  CHECK_THAT(file.out, Contains("is a file, not a serial device"));
}

TEST_CASE("hwprobe refuses what it does not know, and says what there is", "[system][hardware]") {
  const Run driver = probe({"--driver", "orca.hw.P2oz"});
  CHECK(driver.exit_code() == 2);
  CHECK_THAT(driver.err, Contains("there is no driver \"orca.hw.P2oz\"; drivers: ") &&
                             Contains("did you mean \"orca.hw.P2os\"?"));
  CHECK(probe({"--limit", "soon"}).exit_code() == 2);
  CHECK(probe({"--limits", "3"}).exit_code() == 2);
  CHECK(probe({"--limit"}).exit_code() == 2);
  CHECK(probe({"--help"}).exit_code() == 0);
}

TEST_CASE("the ports of a machine are its adapters, each once, by its lasting name if it has one",
          "[system][hardware]") {
  namespace fs = std::filesystem;
  const TempFolder folder;
  const fs::path dev(folder.path());
  for (const char* name : {"ttyUSB0", "ttyUSB1", "ttyACM0", "tty0", "ttyS0", "null"})
    std::ofstream(dev / name) << "";
  fs::create_directories(dev / "serial/by-id");
  fs::create_symlink("../../ttyUSB1", dev / "serial/by-id/usb-Prolific-if00");
  CHECK(orca::hwprobe::serial_ports(dev.string()) ==
        std::vector<std::string>{(dev / "serial/by-id/usb-Prolific-if00").string(),
                                 (dev / "ttyACM0").string(), (dev / "ttyUSB0").string()});
  CHECK(orca::hwprobe::serial_ports((dev / "none").string()).empty());
}

TEST_CASE("hwprobe asks only drivers of cameras at a camera, and only others elsewhere",
          "[system][hardware]") {
  const TempFolder folder;
  const Run camera = probe({folder.file("video7"), "--limit", "1"});
  CHECK(camera.exit_code() == 1);
  CHECK_THAT(camera.out,
             Contains("orca.hw.Camera: there is no " + folder.file("video7")) && !Contains("orca.hw.P2os"));
  const Run file = probe({folder.write("video8", "text"), "--limit", "1"});
  CHECK_THAT(file.out, Contains("video8 is no camera"));
  const Run serial = probe({"tcp:127.0.0.1:1", "--limit", "1"});
  CHECK_THAT(serial.out, !Contains("orca.hw.Camera"));
}

TEST_CASE("what hwprobe says of a picture is short", "[system][hardware]") {
  orca::idl::Image image;
  image.width(640);
  image.height(480);
  image.data().resize(std::size_t{640} * 480 * 3);
  image.data()[7] = 9;
  const std::vector<std::string> lines =
      orca::hwprobe::summary(orca::to_xml(orca::make_object<orca::idl::Image>(image).seal()));
  std::size_t length = 0;
  for (const std::string& line : lines) length += line.size();
  CHECK(length < 500);
  REQUIRE_FALSE(lines.empty());
  CHECK_THAT(lines[0], Contains("width 640") && Contains("height 480"));
}
