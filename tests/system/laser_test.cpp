// SPDX-License-Identifier: GPL-3.0-or-later
// LaserServer, LaserAvoid, VfhPlus, Dwa, NdPlus and PotentialField in a whole system, and the graph that ships with them. What happens on its course
// without any avoid behaviour is in ablation_test.cpp.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr const char* kQuestion = "<connect from=\"avoid.robot\" to=\"base.RobotQuery\"/>";

// Runs the Pioneer's graph with another line in place of avoid's question to the base, and with `param` for avoid.
Run pioneer_with(const std::string& line, const std::string& param, const Words& more = {}) {
  ShippedGraph graph("pioneer_laser_goto");
  graph.watch_motion("base");
  std::string text = graph.text();
  const std::string component = "<param name=\"margin\"";
  for (const auto& [old, changed] :
       {std::pair<std::string, std::string>{kQuestion, line}, {component, param + component}}) {
    const std::size_t place = text.find(old);
    REQUIRE(place != std::string::npos);
    text.replace(place, old.size(), changed);
  }
  const TempFolder folder;
  return run_deployer(Words{folder.write("graph.xml", text)} + virtual_clock() + more);
}

// The same without the question: the graph says the radius.
Run pioneer_of_radius(const std::string& radius) {
  return pioneer_with("", "<param name=\"robot_radius\" value=\"" + radius + "\"/>");
}

std::string describer(const std::string& params) {
  return "<component name=\"describer\" type=\"test.Describer\">" + params +
         "</component><connect from=\"avoid.robot\" to=\"describer.RobotQuery\"/>";
}

std::vector<double> times(const Run& run) {
  std::vector<double> all;
  for (const Arrival& arrival : run.arrivals()) all.push_back(arrival.t);
  return all;
}

// Returns the time of the first line of the log that holds a text [s].
double first_time(const Run& run, const std::string& text) {
  for (const std::string& line : run.said(text))
    if (line.starts_with("[")) return std::strtod(line.c_str() + 1, nullptr);
  return -1.0;
}

// Checks that a robot reaches the three goals of the Pioneer's graph within the time and touches nothing.
void check_three_goals(const Words& more) {
  for (int seed = 1; seed <= part_of(10); ++seed) {
    const Run run = run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--seed",
                                       std::to_string(seed), "--until", "120 s"} +
                                 virtual_clock() + more);
    INFO(run.err);
    CAPTURE(seed);
    CHECK(run.exit_code() == 0);
    const std::vector<Arrival> arrivals = run.arrivals();
    REQUIRE(arrivals.size() == 3);
    CHECK(arrivals[0].name == "kitchen");
    CHECK(arrivals[1].name == "office_2");
    CHECK(arrivals[2].name == "meeting");
    CHECK(arrivals[2].t < 120.0);
    CHECK(run.contacts().empty());
  }
}

const Words kVfhPlus{"--set", "avoid=orca.VfhPlus"};
const Words kDwa{"--set", "avoid=orca.Dwa"};
const Words kNdPlus{"--set", "avoid=orca.NdPlus"};

// Returns what a component says of its ports.
std::string ports_of(const std::string& type) {
  const Run run = run_deployer({"--describe", type});
  INFO(run.err);
  const std::size_t begin = run.out.find("  ports\n");
  const std::size_t end = run.out.find("  parameters\n");
  REQUIRE(begin < end);
  REQUIRE(end != std::string::npos);
  return run.out.substr(begin, end - begin);
}

Run behind_the_pillar(const Words& more = {}) {
  return run_deployer(Words{system_graph("laser.xml")} + virtual_clock() + more);
}

}  // namespace

TEST_CASE("with LaserAvoid a robot passes a pillar on its way and touches nothing", "[system][laser]") {
  const Run run = behind_the_pillar();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
  CHECK(run.contacts().empty());
}

TEST_CASE("without LaserAvoid the robot drives into the pillar", "[system][laser]") {
  const Run run = behind_the_pillar({"--set", "behaviours=goto", "--until", "30 s"});
  INFO(run.err);
  CHECK_FALSE(run.contacts().empty());
}

TEST_CASE("a robot whose laser sees its own posts drives if its file says where, and is blocked if not",
          "[system][laser]") {
  const auto first_goal_of = [](const std::string& robot) {
    return run_deployer(
        Words{source_file("graphs/pioneer_laser_goto.xml"), "--set", "robot=" + robot, "--until", "30 s"} +
        virtual_clock());
  };
  const Run driven = first_goal_of(source_file("sim/fixtures/pioneer_2dx_deck.urdf"));
  INFO(driven.err);
  CHECK(driven.arrivals().size() == 1);
  CHECK(driven.contacts().empty());
  std::string text = read_text(source_file("sim/fixtures/pioneer_2dx_deck.urdf"));
  const std::string ignore = "ignore=\"51 deg, 69 deg; -70 deg, -54 deg\"";
  REQUIRE(text.find(ignore) != std::string::npos);
  text.replace(text.find(ignore), ignore.size(), "");
  const TempFolder folder;
  const Run blocked = first_goal_of(folder.write("deck.urdf", text));
  INFO(blocked.err);
  CHECK(blocked.arrivals().empty());
}

TEST_CASE("LaserAvoid learns from the base how large the robot is, as if the graph said so",
          "[system][laser]") {
  const Run asked = pioneer_with(kQuestion,
                                 "<param name=\"squeeze\" value=\"false\"/>"
                                 "<param name=\"robot_radius\" value=\"1 m\"/>");  // which does not count
  INFO(asked.err);
  REQUIRE(asked.arrivals().size() == 3);
  CHECK(times(asked) == times(pioneer_of_radius("0.309 m")));
  CHECK(times(asked) != times(pioneer_of_radius("0.205 m")));
}

TEST_CASE("a robot that is to squeeze through learns from the base how wide it is, as if the graph said so",
          "[system][laser]") {
  const std::string squeezing = "<param name=\"squeeze\" value=\"true\"/>";
  const auto of_width = [&](const std::string& width) {
    return times(pioneer_with("", squeezing +
                                      "<param name=\"robot_radius\" value=\"0.309 m\"/>"
                                      "<param name=\"robot_length\" value=\"0.6 m\"/>"
                                      "<param name=\"robot_width\" value=\"" +
                                      width + "\"/>"));
  };
  const Run asked = pioneer_with(kQuestion, squeezing + "<param name=\"robot_width\" value=\"1 m\"/>");
  INFO(asked.err);
  REQUIRE(asked.arrivals().size() == 3);
  CHECK(times(asked) == of_width("0.425 m"));
  CHECK(times(asked) != of_width("0.6 m"));
}

TEST_CASE("until the base has said how large the robot is the robot stands, and nothing waits for the answer",
          "[system][laser]") {
  const std::string params =
      "<param name=\"answer_after\" value=\"3 s\"/><param name=\"radius\" value=\"0.3 m\"/>";
  const Run late = pioneer_with(describer(params), "", {"--until", "8 s"});
  INFO(late.err);
  CHECK(late.says("is asked about \"\""));
  CHECK(first_time(late, "watch: moves") > 3.0);
  CHECK(first_time(late, "watch: moves") < 3.5);
  CHECK_FALSE(late.says("nothing is heard of"));  // it says all the time that the robot must stand
}

TEST_CASE("a base that cannot say how large the robot is keeps it from moving, with the reason",
          "[system][laser]") {
  const Run run = pioneer_with(describer(""), "", {"--until", "8 s"});
  INFO(run.err);
  CHECK(run.says("the base does not describe the robot: it has no shape"));
  CHECK(first_time(run, "watch: moves") == -1.0);
}

TEST_CASE("a base that describes a robot that cannot be keeps it from moving, with what is wrong",
          "[system][laser]") {
  const Run run =
      pioneer_with(describer("<param name=\"radius\" value=\"-0.3 m\"/>"), "", {"--until", "8 s"});
  INFO(run.err);
  CHECK(run.says("the base describes no robot that there can be: its radius is -0.3 m"));
  CHECK(first_time(run, "watch: moves") == -1.0);
}

TEST_CASE("the same run with LaserAvoid has the same trace", "[system][laser]") {
  const Run run = behind_the_pillar();
  REQUIRE(run.trace_hash().has_value());
  CHECK(run.trace_hash() == behind_the_pillar().trace_hash());
}

TEST_CASE("the Pioneer drives to three goals in different rooms by its laser and touches nothing",
          "[system][laser][pioneer]") {
  check_three_goals({});
}

TEST_CASE("a wider robot passes the same doors, though their posts seem to stand alone", "[system][laser]") {
  check_three_goals({"--set", "robot=" + source_file("sim/robots/barn_base.urdf")});
}

TEST_CASE("the Pioneer touches nothing at four times its usual speed, from which it needs 4 m to stop",
          "[system][laser][pioneer]") {
  const Words fast{"--set", "goto.max_speed=2 m/s"};
  check_three_goals(fast);
  check_three_goals(fast + kVfhPlus);
}

TEST_CASE("with VfhPlus instead of LaserAvoid the Pioneer reaches the same goals and touches nothing",
          "[system][laser][pioneer][vfh]") {
  check_three_goals(kVfhPlus);
}

TEST_CASE("with VfhPlus the Pioneer reaches its goals at harsh realism too",
          "[system][laser][pioneer][vfh]") {
  check_three_goals(kVfhPlus + Words{"--set", "realism=harsh"});
}

TEST_CASE("VfhPlus has exactly the ports of LaserAvoid", "[system][laser][vfh]") {
  CHECK(ports_of("orca.VfhPlus") == ports_of("orca.LaserAvoid"));
}

TEST_CASE("who does not say which avoid behaviour the Pioneer has gets LaserAvoid", "[system][laser][vfh]") {
  const Words brief =
      Words{source_file("graphs/pioneer_laser_goto.xml"), "--until", "10 s"} + virtual_clock();
  const Run by_default = run_deployer(brief);
  REQUIRE(by_default.trace_hash().has_value());
  CHECK(by_default.trace_hash() ==
        run_deployer(brief + Words{"--set", "avoid=orca.LaserAvoid"}).trace_hash());
  CHECK(by_default.trace_hash() != run_deployer(brief + kVfhPlus).trace_hash());
}

TEST_CASE("the same run with VfhPlus has the same trace", "[system][laser][vfh]") {
  const Words run =
      Words{source_file("graphs/pioneer_laser_goto.xml"), "--until", "60 s"} + virtual_clock() + kVfhPlus;
  const Run first = run_deployer(run);
  REQUIRE(first.trace_hash().has_value());
  CHECK(first.trace_hash() == run_deployer(run).trace_hash());
}

TEST_CASE("Dwa, NdPlus and PotentialField have exactly the ports of LaserAvoid", "[system][laser][dwa][nd]") {
  for (const char* type : {"orca.Dwa", "orca.NdPlus", "orca.PotentialField"})
    CHECK(ports_of(type) == ports_of("orca.LaserAvoid"));
}

TEST_CASE("with Dwa the Pioneer reaches its goals and touches nothing, at harsh realism too",
          "[system][laser][pioneer][dwa]") {
  check_three_goals(kDwa);
  check_three_goals(kDwa + Words{"--set", "realism=harsh"});
}

TEST_CASE("with NdPlus the Pioneer reaches its goals and touches nothing, at harsh realism too",
          "[system][laser][pioneer][nd]") {
  check_three_goals(kNdPlus);
  check_three_goals(kNdPlus + Words{"--set", "realism=harsh"});
}

TEST_CASE("the same run with Dwa, NdPlus or PotentialField has the same trace, whatever executor runs it",
          "[system][laser][dwa][nd]") {
  for (const Words& avoid : {kDwa, kNdPlus, Words{"--set", "avoid=orca.PotentialField"}}) {
    const auto hash_on = [&](const char* executor) {
      return run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--until", "60 s", "--clock",
                                "virtual", "--executor", executor} +
                          avoid)
          .trace_hash();
    };
    const auto first = hash_on("baton");
    REQUIRE(first.has_value());
    CHECK(first == hash_on("baton"));
    if (!kThreadSanitizer) CHECK(first == hash_on("fiber"));  // which it does not support
  }
}

TEST_CASE("the Pioneer's graph drives a robot with a laser at any rate of its odometry and its scans",
          "[system][laser]") {
  const std::string odometry = GENERATE(as<std::string>{}, "10 ms", "50 ms", "100 ms");
  const std::string scan = GENERATE(as<std::string>{}, "30 ms", "181.8 ms", "1 s");
  const TempFolder folder;
  std::string robot = read_text(source_file("sim/robots/create2.urdf"));
  for (const auto& [old, changed] :
       {std::pair<std::string, std::string>{"<odometry period=\"30 ms\"",
                                            "<odometry period=\"" + odometry + "\""},
        {"period=\"181.8 ms\" sweep=\"181.3 ms\"", "period=\"" + scan + "\" sweep=\"" + scan + "\""}}) {
    const std::size_t place = robot.find(old);
    REQUIRE(place != std::string::npos);
    robot.replace(place, old.size(), changed);
  }
  const Run run = run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--set",
                                     "robot=" + folder.write("robot.urdf", robot), "--set",
                                     "world=" + source_file("sim/worlds/hall.xml"), "--set", "place=west",
                                     "--set", "goals=middle: 6 4.5", "--until", "60 s"} +
                               virtual_clock());
  INFO("odometry every " << odometry << ", scans every " << scan << "\n" << run.err);
  CHECK(run.arrivals().size() == 1);
  CHECK(run.contacts().empty());
}
