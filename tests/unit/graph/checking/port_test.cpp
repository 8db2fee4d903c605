// SPDX-License-Identifier: GPL-3.0-or-later
// Ports that a graph renames, disables, or binds late.
#include "loading.hpp"
#include "orca/graph/print.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

const std::string kStartOfRobot =
    "<graph name='g'><hardware name='robot' type='orca.hw.Sim'/>"
    "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>";

Graph with_fuser(const std::string& port, const std::string& rest = "") {
  return must_load(kStartOfRobot +
                   "<component name='avoid' type='orca.SonarAvoid'/><component name='goto' type='orca.Goto'/>"
                   "<component name='localizer' type='orca.Localizer'/>"
                   "<component name='fuser' type='orca.MotionCommandFuser'>" +
                   port + "</component><connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>" +
                   "<connect from='localizer.pose' to='goto.localizer'/>" + rest + "</graph>");
}

}  // namespace

TEST_CASE("a renamed port has only its new name, everywhere", "[graph][port]") {
  const Graph graph =
      must_load(kStartOfRobot +
                "<component name='avoid' type='orca.SonarAvoid' on='echoes'><port name='sonar' as='echoes'/>"
                "</component><connect from='base.SonarRangeReadingsPush' to='avoid.echoes'/></graph>");
  CHECK(graph.edges.at(0).to.port == "echoes");
  CHECK(graph.find_component("avoid")->trigger->ports == std::vector<std::string>{"echoes"});
  CHECK(graph.find_component("avoid")->ports.at("sonar").alias == "echoes");
}

TEST_CASE("a port renamed to its own name is not renamed", "[graph][port]") {
  const Graph graph = must_load(robot_with("<port name='sonar' as='sonar'/>"));
  CHECK(graph.find_component("avoid")->ports.empty());
}

TEST_CASE("a disabled port is remembered, so that nothing connects to it later either", "[graph][port]") {
  const Graph graph = must_load(robot_with("<port name='odometry' disabled='true'/>"));
  CHECK(graph.find_component("avoid")->ports.at("odometry").disabled);
  CHECK(must_load(robot_with("<port name='odometry' disabled='false'/>"))
            .find_component("avoid")
            ->ports.empty());
}

TEST_CASE("a profile can enable what the graph disables", "[graph][port]") {
  const std::string text =
      "<graph name='g'><component name='a' type='orca.Localizer'><port name='odometry' disabled='true'/>"
      "</component><profile name='p'><component name='a'><port name='odometry' disabled='false'/></component>"
      "</profile></graph>";
  CHECK(must_load(text).components.at(0).ports.at("odometry").disabled);
  CHECK(must_load(text, {{"p"}, {}}).components.at(0).ports.empty());
}

TEST_CASE("candidates are edges that wait for the component to name them", "[graph][port]") {
  const Graph graph = with_fuser("<port name='motion' candidates='avoid goto'/>");
  REQUIRE(graph.edges.size() == 4);
  CHECK(graph.edges[2].from.text() == "avoid.motion");
  CHECK(graph.edges[3].from.text() == "goto.MotionPush");
  CHECK(graph.edges[2].late_bound);
  CHECK_FALSE(graph.edges[0].late_bound);
  const auto& candidates = graph.find_component("fuser")->ports.at("motion").candidates;
  CHECK(candidates == std::vector<PortRef>{{"avoid", "motion"}, {"goto", "MotionPush"}});
}

TEST_CASE("candidates of a renamed port, and beside a connection", "[graph][port]") {
  const Graph graph = with_fuser("<port name='motion' as='wishes' candidates='goto.MotionPush'/>",
                                 "<connect from='avoid.motion' to='fuser.wishes'/>");
  CHECK(graph.edges.at(2).from.text() == "avoid.motion");
  CHECK(graph.edges.at(3).to.text() == "fuser.wishes");
  CHECK(graph.find_component("fuser")->ports.at("motion").candidates.size() == 1);
}

TEST_CASE("no candidates at all is no mistake", "[graph][port]") {
  CHECK(with_fuser("<port name='motion' candidates=''/>").find_component("fuser")->ports.empty());
}

TEST_CASE("a printed <port> reads back the same", "[graph][port]") {
  const Graph graph = with_fuser(
      "<port name='motion' as='wishes' candidates='avoid goto'/>"
      "<port name='ClientListSend' disabled='true'/>",
      "");
  CHECK(must_load(print(graph)) == graph);
}

TEST_CASE("ports offer something to the team of the system, and hear it from the others",
          "[graph][port][team]") {
  const std::string text =
      "<graph name='g' join='lab' team_domain='7' team_interface='wlan0'>"
      "<component name='a' type='orca.Localizer'><port name='pose' team='where'/></component>"
      "<component name='b' type='orca.Relay'><port name='in' team='where'/><port name='out' "
      "team='then'/></component>"
      "</graph>";
  const Graph graph = must_load(text);
  CHECK(graph.team.name == "lab");
  CHECK(graph.team.domain == 7);
  CHECK(graph.team.interface == "wlan0");
  REQUIRE(graph.team.ports.size() == 2);
  CHECK(graph.team.ports[0].name == "then");
  CHECK(graph.team.ports[1].name == "where");
  CHECK(graph.team.ports[1].type == "RobotPose");
  CHECK(graph.team.ports[1].hash != 0);
  CHECK(graph.team.ports[1].offers);
  CHECK(graph.find_component("b")->ports.at("in").team == "where");
  CHECK(must_load(print(graph)) == graph);
  CHECK(must_load("<graph name='g' join=''/>").team == Team{});
}

TEST_CASE("what a system only hears from its team it does not offer", "[graph][port][team]") {
  const Graph graph = must_load(
      "<graph name='g' join='lab'><component name='b' type='orca.Relay'><port name='in' "
      "team='where'/></component></graph>");
  REQUIRE(graph.team.ports.size() == 1);
  CHECK_FALSE(graph.team.ports[0].offers);
}
