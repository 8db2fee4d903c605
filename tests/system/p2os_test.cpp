// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of Pioneers with the controller's emulation at the other end of a pseudo terminal: nothing of it is simulated.
#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::P2osFirmware;
using emulators::P2osSettings;

namespace {

using Pioneer = DeviceOnDesk<P2osFirmware, PlainBody>;

Words drive(const std::string& device, const Words& more = {}) {
  return Words{system_graph("p2os.xml"), "--set", "device=" + device} + more;
}

Words far_goal() { return {"--set", "goals=far: 30 0"}; }

// Returns the text of a graph without the lines that name its avoid behaviour.
std::string without_avoid(const std::string& graph) {
  std::ifstream file(graph);
  std::string text;
  for (std::string line; std::getline(file, line);) {
    const std::size_t in_list = line.find("goto; avoid");
    if (in_list != std::string::npos) line.replace(in_list, 11, "goto");
    if (line.find("avoid") == std::string::npos) text += line + "\n";
  }
  return text;
}

bool is_moving(Pioneer& pioneer) {
  return pioneer.with([](P2osFirmware&, PlainBody& body) { return body.velocity().forward > 0.1; });
}

bool stands(Pioneer& pioneer) {
  return pioneer.with([](P2osFirmware&, PlainBody& body) { return body.velocity() == Twist2{}; });
}

bool has_power(Pioneer& pioneer) {
  return pioneer.with([](P2osFirmware& firmware, PlainBody&) { return firmware.has_power(); });
}

}  // namespace

TEST_CASE("a Pioneer drives to its goals over a serial line, and its motors are off before and after",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  const Run run = run_deployer(drive(device), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 2);
  CHECK(run.says("connected to \"Orca_Emu\" (Pioneer p2dx) at 38400 baud"));
  const Pose2 end = pioneer.with([](P2osFirmware&, PlainBody& body) { return body.odometry(); });
  CHECK(std::hypot(end.x - run.arrivals()[1].x, end.y - run.arrivals()[1].y) < 0.1);
  CHECK(stands(pioneer));
  CHECK_FALSE(has_power(pioneer));
  CHECK_FALSE(pioneer.with([](P2osFirmware& firmware, PlainBody&) { return firmware.is_open(); }));
}

TEST_CASE("what goes over the line is kept where the graph says so", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  const std::string log = folder.file("bytes");
  Pioneer pioneer(device);
  const Run run = run_deployer(drive(device, {"--set", "pioneer.byte_log=" + log}), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  std::ifstream file(log);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  CHECK_THAT(text, Catch::StartsWith("# orca byte log 1\n"));
  CHECK_THAT(text, Contains("out  fa fb 03 00 00 00\n"));           // SYNC0
  CHECK_THAT(text, Contains("out  fa fb 06 04 3b 01 00 05 3b\n"));  // power for the motors
  CHECK_THAT(text, Contains("out  fa fb 03 02 00 02\n"));           // CLOSE
}

// A Pioneer 2-DX may have bumpers or not, and does not say so.
TEST_CASE("a Pioneer has the bumpers of its file, and stands when it touches something",
          "[system][hardware]") {
  const bool by_file = GENERATE(true, false);
  CAPTURE(by_file);
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  const std::string robot = by_file ? std::string(ORCA_SOURCE_DIR) + "/sim/robots/pioneer_2dx.urdf" : "";
  Pioneer pioneer(device);
  Subprocess program(deployer(drive(device, {"--set", "pioneer.robot=" + robot}) + far_goal()));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  pioneer.with([](P2osFirmware&, PlainBody& body) { body.touch(1 << 2); });  // the middle one in front
  std::this_thread::sleep_for(2s);
  CHECK(stands(pioneer) == by_file);
}

TEST_CASE("a file that may be that of another robot is a warning, and the robot drives",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  const Run run = run_deployer(
      drive(device, {"--set", "pioneer.robot=" ORCA_SOURCE_DIR "/sim/robots/create2.urdf"}), Seconds(60));
  INFO(run.err);
  CHECK(run.says("is it the file of another robot?"));
  CHECK(run.arrivals().size() == 2);
}

TEST_CASE("the rate of the line is found", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  P2osSettings settings;
  settings.baud = 38400;
  Pioneer pioneer(device, settings);
  const Run run = run_deployer(drive(device), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("at 38400 baud"));
}

TEST_CASE("without a robot on the line nothing starts, and what to look at is said", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  pioneer.fall_silent(true);
  const Run run = run_deployer(drive(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains("no Pioneer answers at serial:" + device +
                               " at 9600, 38400, 19200, 115200, 57600 baud; is it switched on"));
}

TEST_CASE("a robot of another model than the graph says is told", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  P2osSettings settings;
  settings.subclass = "p3dx";
  settings.distance_unit = 0.000485;
  settings.range_unit = 0.001;
  Pioneer pioneer(device, settings);
  const Run run = run_deployer(drive(device), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("the robot calls itself \"p3dx\"; write model=\"p3dx\""));
  const Pose2 end = pioneer.with([](P2osFirmware&, PlainBody& body) { return body.odometry(); });
  CHECK(std::hypot(end.x - 0.6, end.y - 0.4) < 0.5);  // its counts were read as its own
}

TEST_CASE("a model whose limits are not known has those of the graph", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  P2osSettings settings;
  settings.subclass = "mappr";
  Pioneer pioneer(device, settings);
  // It has no sonars in the packets either.
  const std::string graph = folder.write("g.xml", without_avoid(system_graph("p2os.xml")));
  Subprocess program(
      deployer(Words{graph, "--set", "device=" + device, "--set", "model=mappr"} + far_goal()));
  CHECK(eventually([&] { return is_moving(pioneer); }));
}

TEST_CASE("a Pioneer of an unknown model does not move unless the graph says so", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  P2osSettings settings;
  settings.subclass = "p4xx";
  Pioneer pioneer(device, settings);
  SECTION("not even when an operator lets it go") {
    Subprocess program(deployer(drive(device, far_goal())));
    CHECK(program.wait_for_output("the robot calls itself \"p4xx\", which is not known",
                                  Seconds(20 * kSlowdown)));
    CHECK(
        program.wait_for_output("write drive_unknown=\"true\", then orcactl estop", Seconds(20 * kSlowdown)));
    (void)run_orcactl({"estop", "--release"});
    std::this_thread::sleep_for(1s);
    CHECK(pioneer.with([](P2osFirmware&, PlainBody& body) { return body.odometry() == Pose2{}; }));
  }
  SECTION("drive_unknown") {
    Subprocess program(deployer(drive(device, far_goal() + Words{"--set", "pioneer.drive_unknown=true"})));
    CHECK(eventually([&] { return is_moving(pioneer); }));
  }
}

TEST_CASE("a Pioneer's controller is asked for its settings: a short watchdog is fed in time",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  P2osSettings settings;
  settings.watchdog = 220ms;
  Pioneer pioneer(device, settings);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  std::this_thread::sleep_for(2s);
  CHECK(pioneer.with([](P2osFirmware& firmware, PlainBody&) { return firmware.watchdog_stops(); }) == 0);
}

TEST_CASE("a Pioneer's low battery is told, and that its sonars are off", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  P2osSettings settings;
  settings.voltage = 9.0;
  settings.has_sonar_power = false;
  Pioneer pioneer(device, settings);
  Subprocess program(deployer(drive(device)));
  CHECK(program.wait_for_output("its battery is low, at 9.0 V; charge it below 11.0 V",
                                Seconds(20 * kSlowdown)));
  CHECK(
      program.wait_for_output("its sonars are off, although they were switched on", Seconds(20 * kSlowdown)));
}

TEST_CASE(
    "a Pioneer that is unplugged while it drives stops by itself; it comes back and stands until it is let "
    "go",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  pioneer.unplug();
  REQUIRE(eventually([&] { return stands(pioneer); }));  // its own watchdog
  CHECK(pioneer.with([](P2osFirmware& firmware, PlainBody&) { return firmware.watchdog_stops(); }) == 1);
  CHECK(program.wait_for_output("the device has gone: was it unplugged or switched off?",
                                Seconds(20 * kSlowdown)));
  pioneer.plug_in();
  const bool back = program.wait_for_output("it works again", Seconds(30));
  INFO(program.err());
  REQUIRE(back);
  std::this_thread::sleep_for(500ms);
  CHECK(stands(pioneer));
  const Run counted = run_orcactl({"query", "base.DeviceStatisticsQuery", "<Ask/>"});
  CHECK_THAT(counted.out, Contains("connections=\"2\"") && Contains("fault=\"\""));
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return is_moving(pioneer); }));
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
}

TEST_CASE("a controller that is switched off and on in mid-motion is found again, and the robot stands",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  pioneer.with([](P2osFirmware& firmware, PlainBody&) { firmware.reset(steady_now()); });
  CHECK(stands(pioneer));
  REQUIRE(program.wait_for_output("is it still connected and switched on?", Seconds(20 * kSlowdown)));
  REQUIRE(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  CHECK(stands(pioneer));
  CHECK_FALSE(has_power(pioneer));
}

TEST_CASE("kill -9 of the whole system: the controller's watchdog stops the wheels, and it is found again",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  Subprocess program(deployer(drive(device, far_goal() + Words{"--in-process"})));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  program.send(SIGKILL);
  CHECK(eventually([&] { return stands(pioneer); }));
  CHECK(pioneer.with([](P2osFirmware& firmware, PlainBody&) { return firmware.watchdog_stops(); }) == 1);
  CHECK(pioneer.with([](P2osFirmware& firmware, PlainBody&) { return firmware.is_open(); }));
  const Run again = run_deployer(drive(device), Seconds(60));  // it still sends, at the rate of before
  INFO(again.err);
  CHECK(again.exit_code() == 0);
  CHECK(again.says("(Pioneer p2dx) at 38400 baud"));
}

TEST_CASE("the red button takes the motors' power, and only an operator gives it back",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  pioneer.with([](P2osFirmware& firmware, PlainBody&) { firmware.press_button(true); });
  CHECK(program.wait_for_output("its emergency button is pressed", Seconds(20 * kSlowdown)));
  pioneer.with([](P2osFirmware& firmware, PlainBody&) { firmware.press_button(false); });
  std::this_thread::sleep_for(500ms);
  CHECK(stands(pioneer));
  CHECK_FALSE(has_power(pioneer));
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return is_moving(pioneer); }));
}

TEST_CASE("motors that lose their power by themselves are told, and stay off until an operator lets them on",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  pioneer.with([](P2osFirmware& firmware, PlainBody&) { firmware.cut_power(); });
  CHECK(program.wait_for_output("its motors have lost their power", Seconds(20 * kSlowdown)));
  std::this_thread::sleep_for(500ms);
  CHECK(stands(pioneer));
  CHECK_FALSE(has_power(pioneer));
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return is_moving(pioneer); }));
}

TEST_CASE("a base that waits for a person raises an alarm, and its goal waits as long",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  Subprocess program(deployer(drive(device, far_goal() + Words{"--set", "goto.blocked_after=2 s"})));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  pioneer.with([](P2osFirmware& firmware, PlainBody&) { firmware.cut_power(); });
  CHECK(program.wait_for_output("alarm ESTOP: the base is held: its motors have lost their power",
                                Seconds(20 * kSlowdown)));
  CHECK_THAT(run_orcactl({"ps"}).out, Contains("ESTOP"));
  CHECK(run_orcactl({"alarms", "ack", "all"}).exit_code() == 1);
  std::this_thread::sleep_for(4s);  // twice its patience
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return is_moving(pioneer); }));
  CHECK(program.err().find("blocked") == std::string::npos);
  CHECK(eventually([] { return run_orcactl({"alarms", "ack", "all"}).exit_code() == 0; }));
  CHECK(run_orcactl({"ps"}).out.find("ESTOP") == std::string::npos);
}

TEST_CASE("a Pioneer tells what it has and how often it is told of it", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  Pioneer pioneer(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(pioneer); }));
  const Run asked = run_orcactl({"query", "base.RobotQuery", "<Ask about=\"SonarRangeReadings\"/>"});
  INFO(asked.out << asked.err);
  CHECK_THAT(asked.out,
             Contains("number=\"16\"") && Contains("update_interval=\"0.1\"") && Contains("max_range=\"5\""));
  const Run odometry = run_orcactl({"query", "base.RobotQuery", "<Ask about=\"Odometry\"/>"});
  CHECK_THAT(odometry.out, Contains("type=\"Odometry\"") && Contains("update_interval=\"0.1\""));
}
