// SPDX-License-Identifier: GPL-3.0-or-later
// Drivers of real devices that read the file of their robot, with emulated devices at the other ends of pseudo terminals.
#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <string>

#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/sick_lms_firmware.hpp"
#include "record_table.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::P2osFirmware;
using emulators::P2osSettings;
using emulators::SickLmsFirmware;
using emulators::SickLmsSettings;

namespace {

using DeskPioneer = DeviceOnDesk<P2osFirmware, PlainBody>;
using DeskLaser = DeviceOnDesk<SickLmsFirmware, MirrorOnDesk>;

std::string shipped(const std::string& robot) { return source_file("sim/robots/" + robot + ".urdf"); }

// Writes a copy of a shipped robot's file with other words in it, and returns its path.
std::string changed(const TempFolder& folder, const std::string& robot, const std::string& from,
                    const std::string& to) {
  std::string text = read_text(shipped(robot));
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return folder.write(robot + ".urdf", text.replace(at, from.size(), to));
}

// The graph of a Pioneer on a desk, far from its goal.
Words far_drive(const std::string& device, const std::string& file, const Words& more = {}) {
  return Words{system_graph("p2os.xml"), "--set", "device=" + device,     "--set",
               "goals=far: 30 0",        "--set", "pioneer.robot=" + file} +
         more;
}

double speed_of(DeskPioneer& pioneer) {
  return pioneer.with([](P2osFirmware&, PlainBody& body) { return body.velocity().forward; });
}

// Returns the greatest speed of the Pioneer in a second, after it has begun to move.
double top_speed(DeskPioneer& pioneer) {
  REQUIRE(eventually([&] { return speed_of(pioneer) > 0.05; }));
  double top = 0.0;
  for (int i = 0; i < 100; ++i) {
    std::this_thread::sleep_for(10ms);
    top = std::max(top, speed_of(pioneer));
  }
  return top;
}

// A graph of a laser, and who listens to it.
std::string laser_graph(const TempFolder& folder, const std::string& device, const std::string& params) {
  return folder.write("laser.xml",
                      R"(<graph name="laser" version="1"><hardware name="lms" type="orca.hw.SickLms">)"
                      R"(<param name="device" value=")" +
                          device + "\"/>" + params +
                          R"(</hardware><component name="laser" type="orca.LaserServer" )"
                          R"(hardware="lms" autonomous="true"/></graph>)");
}

std::string param(const std::string& name, const std::string& value) {
  return "<param name=\"" + name + "\" value=\"" + value + "\"/>";
}

}  // namespace

TEST_CASE("a real Pioneer goes no faster than its robot file says, or than the graph says against the file",
          "[system][hardware][robot_file]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  const std::string slow = changed(folder, "pioneer_2dx", "max_speed=\"2.2 m/s\"", "max_speed=\"0.2 m/s\"");
  for (const bool overruled : {false, true}) {
    CAPTURE(overruled);
    DeskPioneer pioneer(device);
    const Words more = overruled ? Words{"--set", "pioneer.max_speed=0.1 m/s"} : Words{};
    Subprocess program(deployer(far_drive(device, slow, more)));
    CHECK(top_speed(pioneer) == Approx(overruled ? 0.1 : 0.2).margin(0.005));
    program.send(SIGINT);
    CHECK(finish(program, Seconds(20)).exit_code() == 0);
  }
}

TEST_CASE("a real robot says of itself by Query what its robot file knows",
          "[system][hardware][robot_file]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  DeskPioneer pioneer(device);
  Subprocess program(deployer(far_drive(device, shipped("pioneer_2dx"))));
  REQUIRE(eventually([&] { return speed_of(pioneer) > 0.05; }));
  const Run told = run_orcactl({"query", "base.RobotQuery", "<Ask/>"});
  CHECK_THAT(told.out, Contains("name=\"pioneer_2dx\"") && Contains("vendor=\"ActivMedia Robotics\"") &&
                           Contains("radius=\"0.309\"") && Contains("max_speed=\"2.2\"") &&
                           Contains("speed_change=\"0.5\"") && Contains("steer_gain=\"2\""));
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
}

TEST_CASE("a Pioneer that calls itself another robot than that of its file is told so",
          "[system][hardware][robot_file]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  P2osSettings settings;
  settings.subclass = "p2pb";
  DeskPioneer pioneer(device, settings);
  Subprocess program(deployer(far_drive(device, shipped("pioneer_2dx"))));
  CHECK(program.wait_for_output(
      "has 16 sonars, and a PeopleBot (model=\"p2pb\") has 24; name the model and the "
      "file of the same robot",
      Seconds(20 * kSlowdown)));
}

TEST_CASE("the pose in a real laser's scans is that of the robot file, and what the graph sets counts more",
          "[system][hardware][robot_file]") {
  const TempFolder folder;
  const std::string device = folder.file("lms");
  SickLmsSettings at_once;
  at_once.power_up = 0s;
  for (const bool overruled : {false, true}) {
    CAPTURE(overruled);
    DeskLaser laser(device, at_once);
    const std::string params =
        param("robot", shipped("pioneer_2dx")) + (overruled ? param("z", "0.4 m") : std::string());
    const std::string record = folder.file("scans.csv");
    const Run run = run_deployer({laser_graph(folder, device, params), "--until", "4 s", "--record",
                                  record + "=laser.LaserRangeReadingsPush"},
                                 Seconds(60));
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    const auto rows = RecordTable(record).rows("laser.LaserRangeReadingsPush");
    REQUIRE(rows.size() > 3);
    CHECK(number(rows.back(), "pose.x") == Approx(0.017));
    CHECK(number(rows.back(), "pose.y") == Approx(0.008));
    CHECK(number(rows.back(), "pose.z") == Approx(overruled ? 0.4 : 0.3));
    CHECK(number(rows.back(), "pose.rotation.yaw") == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE(
    "a robot file that does not fit its device is reported at the driver's parameter before anything runs",
    "[system][hardware][robot_file]") {
  const TempFolder folder;
  const std::string graph = laser_graph(folder, "/dev/none", param("robot", shipped("nomad_scout")));
  const Run no_laser = run_deployer({graph, "--check"}, Seconds(30));
  CHECK(no_laser.exit_code() == 2);
  CHECK_THAT(no_laser.err, Contains("laser.xml:1:") && Contains("parameter \"robot\": the robot of ") &&
                               Contains("has no laser; add a <laser> to the file, or leave robot out"));
  const Words pioneer{system_graph("p2os.xml"), "--set", "device=/dev/none", "--check", "--set"};
  const Run missing = run_deployer(pioneer + Words{"pioneer.robot=" + folder.file("none.urdf")}, Seconds(30));
  CHECK(missing.exit_code() == 2);
  CHECK_THAT(missing.err, Contains("none.urdf"));
  const Run holonomic =
      run_deployer(pioneer + Words{"pioneer.robot=" + shipped("nomad_xr4000")}, Seconds(30));
  CHECK(holonomic.exit_code() == 2);
  CHECK_THAT(holonomic.err,
             Contains("has a drive of type holonomic, and this driver drives a differential one"));
  const Run other = run_deployer(pioneer + Words{"pioneer.robot=" + shipped("peoplebot")}, Seconds(30));
  CHECK_THAT(other.err, Contains("has 24 sonars, and a Pioneer 2-DX (model=\"p2dx\") has 16"));
}
