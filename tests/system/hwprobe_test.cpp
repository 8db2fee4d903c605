// SPDX-License-Identifier: GPL-3.0-or-later
// hwprobe with emulated devices on a pseudo terminal.
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <string>

#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "ports.hpp"
#include "tcp_front.hpp"
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
  CHECK_THAT(run.out, Contains("connected to \"Orca_Emu\" (Pioneer p2dx) at 9600 baud"));
  CHECK_THAT(run.out, Contains("<Odometry ") && Contains("<SonarRangeReadings ") && Contains("<Battery "));
  CHECK_THAT(run.out, Contains("0 spoiled, 0 bytes skipped"));
  CHECK_THAT(run.out, Contains("<param name=\"device\" value=\"" + device + "\"/>"));
  pioneer.with([](P2osFirmware& firmware, PlainBody&) {
    CHECK_FALSE(firmware.has_power());
    CHECK_FALSE(firmware.is_open());
    for (const int command : firmware.commands()) CHECK((command != 11 && command != 21));  // none to move
  });
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
  CHECK_THAT(run.out, Contains("<LaserRangeReadings"));
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

TEST_CASE("hwprobe looks for devices of networks at a named connection, and not at serial ports",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("silent");
  Pioneer silent(device);
  silent.fall_silent(true);
  const Run serial = probe({"--limit", "0.2", device});
  CHECK_THAT(serial.out, Contains("orca.hw.P2os: ") && !Contains("orca.hw.Player"));
  CHECK_THAT(probe({"--limit", "0.2", "serial:" + device}).out, !Contains("orca.hw.Player"));
  const Run named = probe({"--limit", "0.2", "--driver", "orca.hw.Player", device});
  CHECK_THAT(named.out, Contains("orca.hw.Player: "));
  TcpFront<orca::emulators::PlayerFirmware, PlainBody> server;
  const Run network = probe({"--limit", "3", server.address()});
  INFO(network.out);
  CHECK(network.exit_code() == 0);
  CHECK_THAT(network.out, Contains("orca.hw.Player: ") && Contains("connected to a Player server"));
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
