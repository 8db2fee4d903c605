// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped graphs of real robots with --profile emulate: the real drivers talk to emulated devices in the simulated world. Most of it runs
// in virtual time, over lines in memory; in real time, over pseudo terminals and connections, what needs an operator or is labelled slow.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "deployer.hpp"
#include "free_port.hpp"
#include "record_table.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using namespace std::chrono_literals;

namespace {

struct Robot {
  const char* graph;
  double length_step;  // [m] resolution of the odometry on the line
  double angle_step;   // [rad]
};

constexpr double kDegree = std::numbers::pi / 180.0;

// A Scout tells 0.1 inch and a tenth of a degree, an XR4000 millimetres and milliradians, a Player server all digits. A Create 2 counts its wheels' turns, of which each may be off by half a count.
constexpr double kCreateCount = std::numbers::pi * 0.072 / 508.8;  // [m]
const std::vector<Robot> kRobots{{"peoplebot", 0.000424, 360.0 / 4096.0 * kDegree},
                                 {"nomad_scout", 0.00254, 0.1 * kDegree},
                                 {"nomad_xr4000", 0.001, 0.001},
                                 {"player_robot", 1e-9, 1e-9},
                                 {"pioneer2dx_sick", 0.00084, 360.0 / 4096.0 * kDegree},
                                 {"create2_rplidar", kCreateCount, 2.0 * kCreateCount / 0.235}};

std::string graph_of(const Robot& robot) {
  return source_file("graphs/" + std::string(robot.graph) + ".xml");
}

Words emulate(const Robot& robot) { return Words{graph_of(robot), "--profile", "emulate"} + virtual_clock(); }

// Two systems of other tests may run at the same time. Lines have names, the server listens at a port.
Words emulate_in_real_time(const Robot& robot, const TempFolder& folder) {
  const bool is_server = robot.graph == std::string("player_robot");
  const std::string place = is_server ? std::to_string(free_port()) : folder.path().filename().string();
  return {graph_of(robot), "--profile", "emulate", "--set", "emulated=" + place};
}

// How the odometry of a robot that stands lies beside the truth there.
struct AtRest {
  double apart = 0.0;   // [m]
  double turned = 0.0;  // [rad]
};

// Compares the last poses, of which the odometry counts from where the robot began, at x 1 m, y 6 m, looking along x.
AtRest compared(const std::string& file) {
  const RecordTable table(file);
  const auto odometry = table.rows("base.OdometryPush");
  const auto truth = table.rows("localizer.RobotPosePush");
  REQUIRE(odometry.size() > 20);
  REQUIRE(truth.size() > 20);
  const double x = number(truth.back(), "x") - number(truth.front(), "x");
  const double y = number(truth.back(), "y") - number(truth.front(), "y");
  const double yaw = number(truth.back(), "orientation");
  REQUIRE(number(truth.front(), "orientation") == 0.0);
  REQUIRE(std::hypot(x, y) > 1.0);
  return {std::hypot(number(odometry.back(), "x") - x, number(odometry.back(), "y") - y),
          std::abs(std::remainder(number(odometry.back(), "steer_angle") - yaw, 2.0 * std::numbers::pi))};
}

// Each device says who made it, which driver of which plugin drives it, and where it is connected.
void check_description(const Run& asked) {
  CHECK(asked.exit_code() == 0);
  const auto devices = asked.out.find("<drives");
  REQUIRE(devices != std::string::npos);
  for (const char* const nothing : {"library=\"\"", "driver=\"\"", "port=\"\"", "vendor=\"\"", "model=\"\""})
    CHECK_THAT(asked.out.substr(devices), !Catch::Contains(nothing));
}

// Returns the last scan of a robot that stands at its start in an ideal world.
RecordTable::Row scan_at_start(const std::string& graph, const Words& more, const TempFolder& folder) {
  const std::string file = folder.file("scans.csv");
  const Run run = run_deployer(
      Words{source_file("graphs/" + graph + ".xml"), "--set", "realism=ideal", "--fail", "goto=silent@0s",
            "--until", "6s", "--record", file + "=laser.LaserRangeReadingsPush"} +
          more,
      Seconds(30));
  INFO(run.err);
  const auto rows = RecordTable(file).rows("laser.LaserRangeReadingsPush");
  REQUIRE(rows.size() > 3);
  return rows.back();
}

Words emulated() { return Words{"--profile", "emulate"} + virtual_clock(); }

// The robot's file with its laser upright, or hanging upside down, at the same place.
Words robot_with_laser(const std::string& robot, const std::string& origin, bool hangs,
                       const TempFolder& folder) {
  std::string text = read_text(source_file("sim/robots/" + robot + ".urdf"));
  const std::string upright = "<origin xyz=\"" + origin + "\"/>";
  REQUIRE(text.find(upright) != std::string::npos);
  if (hangs)
    text.replace(text.find(upright), upright.size(),
                 "<origin xyz=\"" + origin + "\" rpy=\"3.141592653589793 0 0\"/>");
  return {"--set", "robot=" + folder.write(robot + ".urdf", text)};
}

// The driver is told where the laser sits; the simulator reads it from the robot's file.
void check_same_mount(const RecordTable::Row& real, const RecordTable::Row& sim) {
  for (const char* const field : {"pose.x", "pose.y", "pose.z", "pose.rotation.yaw", "angle_start"}) {
    CAPTURE(field);
    CHECK(number(real, field) == Approx(number(sim, field)).margin(1e-12));
  }
}

}  // namespace

TEST_CASE(
    "scans that went over the line are those of the world, to half a millimetre, from where they are taken",
    "[system][hardware]") {
  const bool hangs = GENERATE(false, true);
  CAPTURE(hangs);
  const TempFolder folder;
  const Words robot = robot_with_laser("pioneer_2dx", "0.017 0.008 0.3", hangs, folder);
  const RecordTable::Row sim = scan_at_start("pioneer2dx_sick", virtual_clock() + robot, folder);
  const RecordTable::Row real = scan_at_start("pioneer2dx_sick", emulated() + robot, folder);
  const std::vector<double> wanted = numbers(sim, "ranges");
  const std::vector<double> got = numbers(real, "ranges");
  REQUIRE(wanted.size() == 181);
  REQUIRE(got.size() == 361);
  check_same_mount(real, sim);
  CHECK(2.0 * number(real, "angle_increment") == Approx(number(sim, "angle_increment")));
  CHECK((number(real, "angle_increment") < 0.0) == hangs);
  const auto upright = numbers(scan_at_start("pioneer2dx_sick", virtual_clock(), folder), "ranges");
  for (std::size_t i = 0; i < 181; ++i)
    CHECK(wanted[i] == Approx(upright[hangs ? 180 - i : i]).margin(0.0101));
  int compared = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] >= number(sim, "max_range")) continue;  // nothing comes back
    CAPTURE(i);
    CHECK(std::abs(got[2 * i] - wanted[i]) <= 0.0005 + 1e-9);
    ++compared;
  }
  CHECK(compared > 100);
}

TEST_CASE("turns of an RPLIDAR that went over the line are those of the world, to half a millimetre",
          "[system][hardware]") {
  const bool hangs = GENERATE(false, true);
  CAPTURE(hangs);
  const TempFolder folder;
  const Words robot = robot_with_laser("create2", "0 0 0.135", hangs, folder);
  const RecordTable::Row sim = scan_at_start("create2_rplidar", virtual_clock() + robot, folder);
  const RecordTable::Row real = scan_at_start("create2_rplidar", emulated() + robot, folder);
  const std::vector<double> wanted = numbers(sim, "ranges");
  const std::vector<double> got = numbers(real, "ranges");
  REQUIRE(wanted.size() == 360);
  REQUIRE(got.size() == 360);
  check_same_mount(real, sim);
  CHECK(number(real, "angle_increment") == Approx(number(sim, "angle_increment")));
  int same = 0;
  for (std::size_t i = 0; i < 360; ++i) {
    const auto shows = [&](std::size_t beam) {
      const double range = wanted[beam % 360];
      const bool is_nothing = range >= number(sim, "max_range");
      return is_nothing ? std::isinf(got[i]) : std::abs(got[i] - range) <= 0.0005 + 1e-9;
    };
    CAPTURE(i, wanted[i], got[i]);
    // A point at the edge of a beam may be that of the beam beside it.
    CHECK((shows(i) || shows(i + 1) || shows(i + 359)));
    same += shows(i) ? 1 : 0;
  }
  CHECK(same > 300);
}

TEST_CASE("scans of a Player server are those of the world, as a laser and as a ranger",
          "[system][hardware]") {
  const bool hangs = GENERATE(false, true);  // a server tells the angles of the robot all the same
  CAPTURE(hangs);
  const TempFolder folder;
  const RecordTable::Row sim = scan_at_start("player_robot", virtual_clock(), folder);
  const std::vector<double> wanted = numbers(sim, "ranges");
  REQUIRE(wanted.size() == 181);
  for (const Words& how : {Words{"emulated_as=player", "uses=sonar laser power"},
                           Words{"emulated_as=player:stage", "uses=sonar=ranger:0 laser=ranger:1 power"}}) {
    CAPTURE(how);
    const RecordTable::Row real =
        scan_at_start("player_robot",
                      emulated() + Words{"--set", how[0], "--set", how[1]} +
                          robot_with_laser("pioneer_2dx", "0.017 0.008 0.3", hangs, folder),
                      folder);
    const std::vector<double> got = numbers(real, "ranges");
    REQUIRE(got.size() == 181);
    CHECK(number(real, "angle_start") == Approx(number(sim, "angle_start")).margin(1e-6));
    CHECK(number(real, "angle_increment") == Approx(number(sim, "angle_increment")).margin(1e-6));
    for (const char* const field : {"pose.x", "pose.y", "pose.z"})
      CHECK(number(real, field) == Approx(number(sim, field)).margin(1e-9));
    for (std::size_t i = 0; i < wanted.size(); ++i)
      CHECK(std::min(got[i], 8.0) == Approx(std::min(wanted[i], 8.0)).margin(1e-6));
  }
}

TEST_CASE("each shipped robot reaches all its goals with its real drivers, the same way each time",
          "[system][hardware]") {
  for (const Robot& robot : kRobots) {
    CAPTURE(robot.graph);
    const Run run = run_deployer(emulate(robot), Seconds(60));
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.arrivals().size() == 3);
    CHECK(run.contacts().empty());
    CHECK(run_deployer(emulate(robot), Seconds(60)).out == run.out);
  }
}

TEST_CASE("the real driver of a laser leaves out the posts that the robot's file tells it to ignore",
          "[system][hardware]") {
  const auto drive = [](const std::string& robot) {
    return run_deployer(Words{source_file("graphs/pioneer2dx_sick.xml"), "--profile", "emulate", "--until",
                              "20 s", "--set", "robot=" + robot} +
                            virtual_clock(),
                        Seconds(60));
  };
  const std::string file = source_file("sim/fixtures/pioneer_2dx_deck.urdf");
  const Run driven = drive(file);
  INFO(driven.err);
  CHECK(driven.arrivals().size() == 1);
  CHECK_FALSE(driven.says("it sees itself"));
  std::string text = read_text(file);
  const std::size_t ignore = text.find("ignore=\"");
  REQUIRE(ignore != std::string::npos);
  text.erase(ignore, text.find("deg\"", ignore) + 4 - ignore);
  const TempFolder folder;
  const Run blocked = drive(folder.write("deck.urdf", text));
  INFO(blocked.err);
  CHECK(blocked.arrivals().empty());
  CHECK(blocked.says("it sees itself"));
}

TEST_CASE("in real time each shipped robot reaches all its goals with its real drivers on emulated devices",
          "[.][slow]") {
  for (const Robot& robot : kRobots) {
    CAPTURE(robot.graph);
    const TempFolder folder;
    const Run run = run_deployer(emulate_in_real_time(robot, folder), Seconds(400));
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.arrivals().size() == 3);
    CHECK(run.contacts().empty());
    if (!run.arrivals().empty())
      std::cout << robot.graph << ": " << run.arrivals().size() << " of 3 goals in "
                << run.arrivals().back().t << " s\n";
  }
}

TEST_CASE("in real time each shipped robot drives off on emulated devices, and describes them",
          "[system][hardware]") {
  for (const Robot& robot : kRobots) {
    CAPTURE(robot.graph);
    const TempFolder folder;
    Subprocess program(
        deployer(emulate_in_real_time(robot, folder) + Words{"--set", "goals=ahead: 1.5 6; far: 3.6 6"}));
    CHECK(program.wait_for_output("arrived ahead", Seconds(60)));
    check_description(run_orcactl({"query", "base.RobotQuery", "<Ask/>"}));
    program.send(SIGINT);
    const Run run = finish(program, Seconds(20));
    INFO(run.err);
    CHECK(run.exit_code() == 0);
  }
}

TEST_CASE("odometry that went over the line is that of the world, as finely as the protocol tells it",
          "[system][hardware]") {
  for (const Robot& robot : kRobots) {
    CAPTURE(robot.graph);
    const TempFolder folder;
    const std::string file = folder.file("poses.csv");
    // In an ideal world wheels do not slip, so the truth is what they have rolled.
    const Run run =
        run_deployer(emulate(robot) + Words{"--set", "realism=ideal", "--set", "goals=far: 2.5 6.3 > 9 6",
                                            "--fail", "goto=silent@7s", "--until", "10 s", "--record",
                                            file + "=base.OdometryPush,localizer.RobotPosePush"},
                     Seconds(60));
    INFO(run.err);
    REQUIRE(run.exit_code() == 0);
    const AtRest difference = compared(file);
    // Each coordinate and the direction are rounded once to a step, and steps of coordinates are turned by the first direction.
    CHECK(difference.apart <= 2.0 * robot.length_step + 0.5 * robot.angle_step * 2.1);
    CHECK(difference.turned <= 0.51 * robot.angle_step);
  }
}

TEST_CASE("with --clock virtual a line to a real device is refused by --check, with its place",
          "[system][hardware]") {
  const Run run = run_deployer(
      {source_file("graphs/pioneer2dx_sick.xml"), "--profile", "real", "--clock", "virtual", "--check"},
      Seconds(60));
  CHECK(run.exit_code() == 2);
  CHECK_THAT(
      run.err,
      Contains("error G042: hardware \"pioneer\": parameter \"device\": in virtual time nothing is at the "
               "other end of \"/dev/ttyS0\"; use emulated:NAME"));
}

TEST_CASE("a driver of an emulated line that nothing offers is found by --check, with its place",
          "[system][hardware]") {
  std::ifstream file(source_file("graphs/pioneer2dx_sick.xml"));
  std::string text(std::istreambuf_iterator<char>(file), {});
  const auto exchange = [&](const std::string& old, const std::string& fresh) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += fresh.size())
      text.replace(at, old.size(), fresh);
  };
  exchange("../sim/", ORCA_SOURCE_DIR "/sim/");
  exchange("value=\"emulated:${emulated}_laser\"", "value=\"emulated:pioner_laser\"");
  const TempFolder folder;
  const std::string graph = folder.write("nobody.xml", text);
  const Words check{graph, "--profile", "emulate", "--set", "emulated=pioneer", "--check"};
  const Run misspelt = run_deployer(check, Seconds(60));
  CHECK(misspelt.exit_code() == 2);
  const std::size_t at = text.find("emulated:pioner_laser");
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  CHECK_THAT(misspelt.err,
             Contains("nobody.xml:" + std::to_string(line) + ":") &&
                 Contains("error G042: hardware \"sick\": parameter \"device\": nothing in this "
                          "graph emulates \"pioner_laser\"; did you mean \"pioneer_laser\"?"));
  const Run elsewhere = run_deployer({source_file("graphs/pioneer2dx_sick.xml"), "--profile", "real",
                                      "--check", "--set", "base_port=emulated:nobody"},
                                     Seconds(60));
  CHECK(elsewhere.exit_code() == 0);  // another system may emulate it
  CHECK_THAT(elsewhere.err,
             Contains("warning G057") && Contains("nothing in this graph emulates \"nobody\", so another"));
}
