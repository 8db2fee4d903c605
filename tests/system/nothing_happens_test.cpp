// SPDX-License-Identifier: GPL-3.0-or-later
// A system in which nothing happens says why: warnings of --check, and lines at the end of a run.
#include <catch2/catch.hpp>

#include <algorithm>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kScout = R"(<hardware name="scout" type="orca.hw.Sim">
    <param name="world" value=")" +
                           source_file("sim/worlds/office.xml") + R"("/>
    <param name="robot" value=")" +
                           source_file("sim/robots/nomad_scout.urdf") + R"("/>
    <param name="place" value="start"/></hardware>
)";
const std::string kBase = kScout + R"(<component name="base" type="orca.RobotBaseServer" hardware="scout"/>
)";

Run run_graph(const std::string& attributes, const std::string& elements, const Words& words) {
  const TempFolder folder;
  return run_deployer(Words{folder.write("graph.xml", "<graph name=\"g\" version=\"1\" " + attributes +
                                                          ">\n" + elements + "</graph>\n")} +
                      words);
}

Run check(const std::string& elements) { return run_graph("", elements, {"--check"}); }

// The behaviours and the base of random_walk.xml, with a fuser to which nobody gives a list of behaviours.
const std::string kForgottenList = kBase + R"(<component name="walk" type="orca.RandomWalk"/>
  <component name="fuser" type="orca.MotionCommandFuser"/>
  <connect from="walk.motion" to="fuser.motion"/>
  <connect from="fuser.base" to="base.MotionCommandSend"/>
  <connect from="base.SonarRangeReadingsPush" to="walk.sonar"/>
)";

}  // namespace

TEST_CASE("--check warns of a fuser without behaviours, at its line and column", "[system][nothing]") {
  const Run run = check(kBase + R"(<component name="fuser" type="orca.MotionCommandFuser"/>
<connect from="fuser.base" to="base.MotionCommandSend"/>
)");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.err,
             Contains("graph.xml:7:1: warning G056: component \"fuser\": its port \"motion\" collects"));
}

TEST_CASE("--check warns of a chain that nobody uses, and names all of it", "[system][nothing]") {
  const Run run = check(kBase + R"(<component name="avoid" type="orca.SonarAvoid"/>
<connect from="base.SonarRangeReadingsPush" to="avoid.sonar"/>
)");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.err,
             Contains("graph.xml:7:1: warning G051: component \"avoid\": nobody listens to what it pushes: "
                      "motion; and what only it uses never works either: base"));
}

TEST_CASE("no shipped graph has a warning, so --strict takes them all", "[system][nothing]") {
  const TempFolder folder;
  const std::vector<std::string> graphs = shipped_graphs();
  for (const std::string& graph : graphs) {
    const Run run = run_deployer(Words{source_file("graphs/" + graph + ".xml"), "--check", "--strict"} +
                                 needed_arguments(graph, folder));
    CAPTURE(graph);
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK_FALSE(run.says("warning"));
  }
  CHECK(graphs.size() >= 5);
}

TEST_CASE("a run whose fuser gets no list of behaviours says who never worked, and why",
          "[system][nothing]") {
  const Run run = run_graph("", kForgottenList, Words{"--until", "2 s"} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says(
      "warning fuser: has never worked in this run: nobody listens to it, and neither its parameters "
      "nor what was sent to it made it work"));
  CHECK(run.says(
      "warning walk: has never worked in this run: none of those that it is connected to has subscribed: "
      "fuser"));
  CHECK(run.says("warning base: has never worked in this run"));
  CHECK(run.says("warning deployer: no connection has carried anything in this run"));
  CHECK(run.lines().size() == 1);  // the hash: nothing of it is for stdout
}

TEST_CASE("a base that the graph calls autonomous does not go idle when no commands come",
          "[system][nothing]") {
  const TempFolder folder;
  const std::string base =
      kScout +
      R"(<component name="base" type="orca.RobotBaseServer" hardware="scout" autonomous="true"/>
)";
  const Run run =
      run_graph("", base, Words{"--until", "3 s", "--trace", folder.file("trace")} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const std::vector<std::string> lines = split_lines(read_text(folder.file("trace")));
  const auto begins =
      std::ranges::find_if(lines, [](const auto& l) { return l.ends_with("base CONNECT WORK"); });
  const auto ends = std::ranges::find_if(lines, [](const auto& l) { return l.ends_with("base WORK IDLE"); });
  REQUIRE(begins != lines.end());
  REQUIRE(ends != lines.end());
  CHECK(std::stod(*ends) == Approx(3.0));  // with the run
}

TEST_CASE("--until that comes before the end of the graph says what was not done", "[system][nothing]") {
  const Run run =
      run_deployer(Words{source_file("graphs/scout_goto.xml"), "--until", "2 s"} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(
      run.says("info    deployer: the time limit has ended the run before these were done: command (WORK)"));
  CHECK_FALSE(run.says("warning"));
}
