// SPDX-License-Identifier: GPL-3.0-or-later
// Features of graphs beyond components and connections, shown by runs.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

using Replacements = std::vector<std::pair<std::string, std::string>>;

const std::string kOneGoal = "kitchen: 3.6 6 &gt; 3.6 7.6 &gt; 4.2 9.8";

// Returns scout_goto.xml with one goal and with absolute paths to the world and the robot.
std::string scout_graph(const Replacements& replacements) {
  std::string text = read_text(source_file("graphs/scout_goto.xml"));
  Replacements all{{"\"../sim/worlds", "\"" + source_file("sim/worlds")},
                   {"\"../sim/robots", "\"" + source_file("sim/robots")}};
  all.insert(all.end(), replacements.begin(), replacements.end());
  for (const auto& [from, to] : all) {
    const std::size_t at = text.find(from);
    INFO(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  }
  const std::size_t goals = text.find("default=\"kitchen:") + 9;
  return text.replace(goals, text.find('"', goals) - goals, kOneGoal);
}

Run drive(const TempFolder& folder, const std::string& text, const Words& more = {}) {
  return run_deployer(Words{folder.write("graph.xml", text)} + virtual_clock() + more);
}

void check_arrives(const Run& run) {
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals().front().name == "kitchen");
}

// Replacements that make the fuser's behaviours candidates instead of connections.
const Replacements kLateBound{
    {"<component name=\"fuser\" type=\"orca.MotionCommandFuser\">",
     "<component name=\"fuser\" type=\"orca.MotionCommandFuser\"><port name=\"motion\" "
     "candidates=\"goto avoid\"/>"},
    {"<connect from=\"goto.MotionCmdPush\" to=\"fuser.motion\"/>", ""},
    {"<connect from=\"avoid.motion\" to=\"fuser.motion\"/>", ""}};

// A robot with so many avoid behaviours that each gets what its laser and its odometry tell. @param params  of one of them, by its number.
std::string crowded_graph(int avoiders, const std::function<std::string(int)>& params) {
  std::ostringstream text;
  text << "<graph name='crowd' version='1'>\n<hardware name='robot' type='orca.hw.Sim'><param name='world' "
          "value='"
       << source_file("sim/worlds/office.xml") << "'/><param name='robot' value='"
       << source_file("sim/robots/pioneer_2dx.urdf") << "'/><param name='place' value='start'/></hardware>\n"
       << "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>\n"
       << "<component name='laser' type='orca.LaserServer' hardware='robot'/>\n";
  for (int i = 0; i < avoiders; ++i) {
    const std::string name = "a" + std::to_string(i);
    text << "<component name='" << name << "' type='orca.LaserAvoid' autonomous='true'>" << params(i)
         << "</component>\n<connect from='laser.LaserRangeReadingsPush' to='" << name
         << ".laser'/>\n<connect from='base.OdometryPush' to='" << name << ".odometry' queue='256'/>\n";
  }
  text << "</graph>\n";
  return text.str();
}

}  // namespace

TEST_CASE("behaviours that are only candidates of the fuser drive the robot to its goal", "[system][graph]") {
  const TempFolder folder;
  check_arrives(drive(folder, scout_graph(kLateBound)));
}

TEST_CASE("a behaviour that is not a candidate is an error of the graph at its place, and nothing starts",
          "[system][graph]") {
  const TempFolder folder;
  Replacements lurker = kLateBound;
  lurker.emplace_back("value=\"goto; avoid\"", "value=\"goto; lurker\"");
  const Run run = drive(folder, scout_graph(lurker));
  INFO(run.err);
  CHECK(run.exit_code() == kRefusedByComponent);
  CHECK(run.says("no behaviour \"lurker\" is connected to fuser.motion"));
  if (kThreadSanitizer) return;
  CHECK(run.says("graph.xml:" + line_of(source_file("graphs/scout_goto.xml"), "name=\"behaviours\"") +
                 ":37: error G062: component \"command\": parameter \"behaviours\""));
  CHECK(split_lines(run.err).size() == 1);
}

TEST_CASE("a behaviour that is not a candidate is refused at run time if nobody has asked before",
          "[system][graph]") {
  const TempFolder folder;
  Replacements lurker = kLateBound;
  lurker.emplace_back("value=\"goto; avoid\"", "value=\"goto; lurker\"");
  lurker.emplace_back("<connect from=\"command.check\" to=\"fuser.ClientListQuery\"/>", "");
  const Run run = drive(folder, scout_graph(lurker));
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("no behaviour \"lurker\" is connected to fuser.motion"));
  CHECK(run.says("goto.MotionCmdPush, avoid.motion"));
}

TEST_CASE("a system runs with renamed and disabled ports, and calls them by their new names",
          "[system][graph]") {
  const TempFolder folder;
  const Run run = drive(
      folder,
      scout_graph({{"<component name=\"avoid\" type=\"orca.SonarAvoid\"/>",
                    "<component name=\"avoid\" type=\"orca.SonarAvoid\"><port name=\"sonar\" as=\"echoes\"/>"
                    "<port name=\"motion\" as=\"wish\"/></component>"},
                   {"hardware=\"scout\"/>",
                    "hardware=\"scout\"><port name=\"OdometryPush\" as=\"odom\"/><port "
                    "name=\"RobotQuery\" disabled=\"true\"/></component>"},
                   {"\"avoid.motion\"", "\"avoid.wish\""},
                   {"\"avoid.sonar\"", "\"avoid.echoes\""},
                   {"\"base.OdometryPush\"", "\"base.odom\""}}),
      {"--trace", folder.file("trace.txt")});
  check_arrives(run);
  const std::string trace = read_text(folder.file("trace.txt"));
  CHECK(trace.find("avoid echoes") != std::string::npos);
  CHECK(trace.find("avoid sonar") == std::string::npos);
}

TEST_CASE("a whole robot runs as a sub-graph, its own names local to it", "[system][graph]") {
  const TempFolder folder;
  folder.write("robot.xml", scout_graph({}));
  const Run run = drive(folder,
                        "<graph name=\"fleet\" ends=\"Platforms/Dewey/command\" default_profile=\"sim\">"
                        "<use graph=\"robot.xml\" prefix=\"Platforms/Dewey\"><arg name=\"realism\" "
                        "value=\"ideal\"/></use></graph>");
  check_arrives(run);
}

TEST_CASE("a graph that is printed and loaded again runs bit for bit the same", "[system][graph]") {
  const TempFolder folder;
  const std::string text = scout_graph(kLateBound);
  const Run printed = run_deployer({folder.write("first.xml", text), "--print"});
  REQUIRE(printed.exit_code() == 0);
  const Run one = drive(folder, text);
  const Run other = drive(folder, printed.out);
  check_arrives(one);
  check_arrives(other);
  CHECK(one.trace_hash());
  CHECK(one.trace_hash() == other.trace_hash());
}

TEST_CASE("--diff says by its exit code whether two graphs are the same", "[system][graph]") {
  const TempFolder folder;
  const std::string same = folder.write("same.xml", scout_graph({}));
  const std::string other = folder.write("other.xml", scout_graph(kLateBound));
  const Run equal = run_deployer({"--diff", same, same});
  CHECK(equal.exit_code() == 0);
  CHECK(equal.out.empty());
  const Run different = run_deployer({"--diff", same, other});
  CHECK(different.exit_code() == 1);
  CHECK(different.out.find("~ component fuser") != std::string::npos);
  const Run broken = run_deployer({"--diff", same, folder.file("missing.xml")});
  CHECK(broken.exit_code() == 2);
  CHECK(broken.out.empty());
}

TEST_CASE("--strict starts nothing when there is a warning", "[system][graph]") {
  const TempFolder folder;
  const std::string text = scout_graph({{"<component name=\"command\"",
                                         "<arg name=\"spare\" default=\"1\"/>"
                                         "<component name=\"command\""}});
  const std::string file = folder.write("graph.xml", text);
  const Run run = run_deployer({file, "--strict"});
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  CHECK(run.says("error G041"));
  const Run lenient = run_deployer({file, "--check"});
  CHECK(lenient.exit_code() == 0);
  CHECK(lenient.says("warning G041"));
}

TEST_CASE("--check --json reports errors on stdout and nothing else", "[system][graph]") {
  const TempFolder folder;
  const Run run = run_deployer(
      {folder.write("graph.xml", "<graph name=\"g\"><component name=\"a\" type=\"orca.Nothing\"/></graph>"),
       "--check", "--json"});
  CHECK(run.exit_code() == 2);
  CHECK(run.err.empty());
  CHECK(run.out.find("\"errors\": 1") != std::string::npos);
  CHECK(run.out.find("\"code\": \"G027\"") != std::string::npos);
  CHECK(run.out.find("\"line\": 1") != std::string::npos);
}

TEST_CASE("each way to look at a graph prints it and starts nothing", "[system][graph]") {
  for (const auto& [option, start] : {std::pair<std::string, std::string>{"--dot", "digraph"},
                                      {"--mermaid", "---\ntitle: scout_goto, profile sim"},
                                      {"--list-ports", "command.TripQuery"},
                                      {"--print", "<?xml"}}) {
    const Run run = run_deployer({source_file("graphs/scout_goto.xml"), option});
    CAPTURE(option);
    CHECK(run.exit_code() == 0);
    CHECK(run.out.starts_with(start));
    CHECK(run.err.empty());
  }
}

TEST_CASE("two things to do at once, and --json where it means nothing, are refused", "[system][graph]") {
  const std::string graph = source_file("graphs/scout_goto.xml");
  for (const Words& words :
       {Words{graph, "--check", "--dot"}, Words{graph, "--json"}, Words{graph, "--dot", "--json"},
        Words{"--diff", graph}, Words{"--diff", graph, graph, graph}}) {
    const Run run = run_deployer(words);
    CAPTURE(words);
    CHECK(run.exit_code() == 2);
    CHECK(run.out.empty());
    CHECK(run.err.starts_with("command line: error C"));
  }
}

TEST_CASE("ten thousand components of shipped plugins are checked in 250 MB", "[system][graph]") {
  const TempFolder folder;
  const std::string graph = folder.write("crowd.xml", crowded_graph(9998, [](int) { return std::string(); }));
  const Run run = run_deployer({graph, "--check"}, Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("no errors; 10000 components, 19996 connections"));
  WARN("checked in " << run.ending.cpu.count() << " s of processor time and " << run.ending.peak << " MB");
  if (!kSanitized) CHECK(run.ending.peak < 250.0);
  CHECK(run.ending.cpu.count() < 6.0 * kSlowCode);  // 1.5 s on an idle machine
}

TEST_CASE("among thousands of components that all differ --check finds the one that refuses its parameters",
          "[system][graph]") {
  const TempFolder folder;
  const auto params = [](int i) {
    if (i == 2400) return std::string("<param name='stop_distance' value='3 m'/>");
    return "<param name='margin' value='" + std::to_string(0.05 + 1e-5 * i) + " m'/>";
  };
  const std::string graph = folder.write("crowd.xml", crowded_graph(2500, params));
  const Run run = run_deployer({graph, "--check"}, Seconds(60));
  CHECK(run.exit_code() == 2);
  CHECK_THAT(run.err, Catch::Contains("G062: component \"a2400\": parameter \"stop_distance\""));
  CHECK(split_lines(run.err).size() == 1);
}
