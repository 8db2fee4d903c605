// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of Pioneers with the controller's emulation at the other end of a line in memory, in virtual time; the cases at the end have
// a pseudo terminal and real time.
#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "base_on_desk.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::P2osFirmware;
using emulators::P2osSettings;

namespace {

using Pioneer = VirtualBase<P2osFirmware>;
using PioneerInRealTime = BaseOn<DeviceOnDesk, P2osFirmware>;

Run run(const Words& more = {}, const std::function<void()>& script = {}) {
  return run_virtual(on_line("p2os.xml", "memory:pioneer", more), script);
}

P2osSettings with_subclass(const std::string& subclass) {
  P2osSettings settings;
  settings.subclass = subclass;
  return settings;
}

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

template <class AnyPioneer>
bool is_open(AnyPioneer& pioneer) {
  return pioneer.ask(&P2osFirmware::is_open);
}

// Checks that the robot stands without power until an operator lets it go.
void check_waits(Pioneer& pioneer) {
  bench().sleep(500ms);
  CHECK(pioneer.stands());
  CHECK_FALSE(pioneer.has_power());
  pioneer.check_waits_for_operator();
}

}  // namespace

TEST_CASE("what goes over the line is kept where the graph says so", "[system][hardware]") {
  const TempFolder folder;
  const std::string log = folder.file("bytes");
  Pioneer pioneer("pioneer");
  CHECK(run({"--set", "pioneer.byte_log=" + log}).exit_code() == 0);
  const std::string text = read_text(log);
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
  Pioneer pioneer("pioneer");
  const std::string robot = by_file ? std::string(ORCA_SOURCE_DIR) + "/sim/robots/pioneer_2dx.urdf" : "";
  (void)run(far_goal({"--set", "pioneer.robot=" + robot}), [&] {
    pioneer.set_off();
    pioneer.body([](PlainBody& body) { body.touch(1 << 2); });  // the middle one in front
    bench().sleep(2s);
    CHECK(pioneer.stands() == by_file);
  });
}

TEST_CASE("a file that may be that of another robot is a warning, and the robot drives",
          "[system][hardware]") {
  Pioneer pioneer("pioneer");
  const Run ended = run({"--set", "pioneer.robot=" ORCA_SOURCE_DIR "/sim/robots/create2.urdf"});
  CHECK(ended.says("is it the file of another robot?"));
  CHECK(ended.arrivals().size() == 2);
}

TEST_CASE("the rate of the line is found", "[system][hardware]") {
  P2osSettings settings;
  settings.baud = 38400;
  Pioneer pioneer("pioneer", settings);
  const Run ended = run();
  CHECK(ended.exit_code() == 0);
  CHECK(ended.says("at 38400 baud"));
}

TEST_CASE("without a robot on the line nothing starts, and what to look at is said", "[system][hardware]") {
  Pioneer pioneer("pioneer");
  pioneer.fall_silent(true);
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err, Contains("no Pioneer answers at memory:pioneer at 9600, 38400, 19200, 115200, 57600 "
                                 "baud; is it switched on"));
}

TEST_CASE("a robot of another model than the graph says is told", "[system][hardware]") {
  P2osSettings settings = with_subclass("p3dx");
  settings.distance_unit = 0.000485;
  settings.range_unit = 0.001;
  Pioneer pioneer("pioneer", settings);
  const Run ended = run();
  CHECK(ended.exit_code() == 0);
  CHECK(ended.says("the robot calls itself \"p3dx\"; write model=\"p3dx\""));
  CHECK(std::hypot(pioneer.pose().x - 0.6, pioneer.pose().y - 0.4) < 0.5);  // its counts were read as its own
}

TEST_CASE("a model whose limits are not known has those of the graph", "[system][hardware]") {
  const TempFolder folder;
  Pioneer pioneer("pioneer", with_subclass("mappr"));
  // It has no sonars in the packets either.
  const std::string graph = folder.write("g.xml", without_avoid(system_graph("p2os.xml")));
  (void)run_virtual(Words{graph} + far_goal({"--set", "device=memory:pioneer", "--set", "model=mappr"}),
                    [&] { pioneer.set_off(); });
}

TEST_CASE("a Pioneer of an unknown model does not move unless the graph says so", "[system][hardware]") {
  Pioneer pioneer("pioneer", with_subclass("p4xx"));
  SECTION("not even when an operator lets it go") {
    (void)run(far_goal(), [&] {
      CHECK(bench().until_log("the robot calls itself \"p4xx\", which is not known"));
      CHECK(bench().until_log("write drive_unknown=\"true\", then orcactl estop"));
      (void)bench().seat().let_go();
      bench().sleep(1s);
      CHECK(pioneer.pose() == Pose2{});
    });
  }
  SECTION("drive_unknown") {
    (void)run(far_goal({"--set", "pioneer.drive_unknown=true"}), [&] { pioneer.set_off(); });
  }
}

TEST_CASE("a Pioneer's controller is asked for its settings: a short watchdog is fed in time",
          "[system][hardware]") {
  P2osSettings settings;
  settings.watchdog = 220ms;
  Pioneer pioneer("pioneer", settings);
  (void)run(far_goal(), [&] {
    pioneer.set_off();
    bench().sleep(2s);
    CHECK(pioneer.watchdog_stops() == 0);
  });
}

TEST_CASE("a Pioneer's low battery is told, and that its sonars are off", "[system][hardware]") {
  P2osSettings settings;
  settings.voltage = 9.0;
  settings.has_sonar_power = false;
  Pioneer pioneer("pioneer", settings);
  (void)run({}, [] {
    CHECK(bench().until_log("its battery is low, at 9.0 V; charge it below 11.0 V"));
    CHECK(bench().until_log("its sonars are off, although they were switched on"));
  });
}

TEST_CASE(
    "a Pioneer that is unplugged while it drives stops by itself; it comes back and stands until it is let "
    "go",
    "[system][hardware]") {
  Pioneer pioneer("pioneer");
  const Run ended = run(far_goal(), [&] {
    pioneer.set_off();
    pioneer.unplug();
    REQUIRE(bench().until([&] { return pioneer.stands(); }));  // its own watchdog
    CHECK(pioneer.watchdog_stops() == 1);
    CHECK(bench().until_log("the other end of the line is closed"));
    pioneer.plug_in();
    REQUIRE(bench().until_log("it works again"));
    bench().sleep(500ms);
    CHECK(pioneer.stands());
    CHECK(bench().seat().statistics().connections() == 2);
    CHECK(bench().seat().statistics().fault().empty());
    pioneer.check_waits_for_operator();
  });
  CHECK(ended.exit_code() == 0);
}

TEST_CASE("a controller that is switched off and on in mid-motion is found again, and the robot stands",
          "[system][hardware]") {
  Pioneer pioneer("pioneer");
  (void)run(far_goal(), [&] {
    pioneer.set_off();
    pioneer.reset();
    CHECK(pioneer.stands());
    REQUIRE(bench().until_log("is it still connected and switched on?"));
    REQUIRE(bench().until_log("it works again"));
    CHECK(pioneer.stands());
    CHECK_FALSE(pioneer.has_power());
  });
}

TEST_CASE("the red button takes the motors' power, and only an operator gives it back",
          "[system][hardware]") {
  Pioneer pioneer("pioneer");
  (void)run(far_goal(), [&] {
    pioneer.set_off();
    pioneer.look([](P2osFirmware& firmware) { firmware.press_button(true); });
    CHECK(bench().until_log("its emergency button is pressed"));
    pioneer.look([](P2osFirmware& firmware) { firmware.press_button(false); });
    check_waits(pioneer);
  });
}

TEST_CASE("motors that lose their power by themselves are told, and stay off until an operator lets them on",
          "[system][hardware]") {
  Pioneer pioneer("pioneer");
  (void)run(far_goal(), [&] {
    pioneer.set_off();
    pioneer.look([](P2osFirmware& firmware) { firmware.cut_power(); });
    CHECK(bench().until_log("its motors have lost their power"));
    check_waits(pioneer);
  });
}

TEST_CASE("a Pioneer tells what it has and how often it is told of it", "[system][hardware]") {
  Pioneer pioneer("pioneer");
  (void)run(far_goal(), [&] {
    pioneer.set_off();
    const idl::Robot robot = bench().seat().description();
    REQUIRE(robot.sonar_rings().size() == 1);
    CHECK(robot.sonar_rings()[0].number() == 16);
    CHECK(robot.sonar_rings()[0].update_interval() == 0.1);
    CHECK(robot.sonar_rings()[0].max_range() == 5.0);
    const auto odometry =
        std::ranges::find(robot.sensors(), "Odometry", [](const idl::Sensor& one) { return one.type(); });
    REQUIRE(odometry != robot.sensors().end());
    CHECK(odometry->update_interval() == 0.1);
  });
}

TEST_CASE("a Pioneer drives to its goals over a serial line, and its motors are off before and after",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  PioneerInRealTime pioneer(device);
  const Run ended = run_deployer(on_line("p2os.xml", device), Seconds(60));
  pioneer.check_at_goal(ended);
  CHECK(ended.says("connected to \"Orca_Emu\" (Pioneer p2dx) at 38400 baud"));
  CHECK_FALSE(pioneer.has_power());
  CHECK_FALSE(is_open(pioneer));
}

TEST_CASE("kill -9 of the whole system: the controller's watchdog stops the wheels, and it is found again",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  PioneerInRealTime pioneer(device);
  (void)kill_while_it_drives(pioneer, on_line("p2os.xml", device), [&] { return pioneer.stands(); });
  CHECK(pioneer.watchdog_stops() == 1);
  CHECK(is_open(pioneer));
  // It still sends, at that rate.
  const Run again = run_deployer(on_line("p2os.xml", device, {"--set", "goals=here: 0 0"}), Seconds(60));
  INFO(again.err);
  CHECK(again.exit_code() == 0);
  CHECK(again.says("(Pioneer p2dx) at 38400 baud"));
}

// It is about the alarms of all bases, and so about orcactl.
TEST_CASE("a base that waits for a person raises an alarm, and its goal waits as long",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("pioneer");
  PioneerInRealTime pioneer(device);
  Subprocess program(deployer(on_line("p2os.xml", device, far_goal({"--set", "goto.blocked_after=2 s"}))));
  REQUIRE(eventually([&] { return pioneer.moves(); }));
  pioneer.look([](P2osFirmware& firmware) { firmware.cut_power(); });
  CHECK(program.wait_for_output("alarm ESTOP: the base is held: its motors have lost their power",
                                Seconds(20 * kSlowdown)));
  CHECK_THAT(run_orcactl({"ps"}).out, Contains("ESTOP"));
  CHECK(run_orcactl({"alarms", "ack", "all"}).exit_code() == 1);
  const Run asked = run_orcactl({"query", "base.RobotQuery", "<Ask about=\"SonarRangeReadings\"/>"});
  CHECK_THAT(asked.out, Contains("number=\"16\"") && Contains("update_interval=\"0.1\""));
  std::this_thread::sleep_for(4s);  // twice its patience
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return pioneer.moves(); }));
  CHECK(program.err().find("blocked") == std::string::npos);
  CHECK(eventually([] { return run_orcactl({"alarms", "ack", "all"}).exit_code() == 0; }));
  CHECK(run_orcactl({"ps"}).out.find("ESTOP") == std::string::npos);
}
