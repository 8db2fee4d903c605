// SPDX-License-Identifier: GPL-3.0-or-later
// --set COMPONENT.PARAM=VALUE: the command line has the last word about a parameter.
#include <filesystem>

#include "loading.hpp"
#include "orca/graph/print.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

LoadOptions with(std::vector<std::string> settings) { return {{}, std::move(settings)}; }

const Files kPair{{"main.xml",
                   "<graph name='g'><use graph='arm.xml' prefix='left'/>"
                   "<use graph='arm.xml' prefix='right'/></graph>"},
                  {"arm.xml", robot_with("<param name='stop_distance' value='1 m'/>")}};

}  // namespace

TEST_CASE("a parameter from the command line replaces that of the graph, or its default", "[graph][set]") {
  const std::string text = robot_with("<param name='stop_distance' value='1 m'/>");
  CHECK(stop_distance(must_load(text, with({"avoid.stop_distance=20 cm"}))) == 0.2);
  CHECK(stop_distance(must_load(robot_with(""), with({"avoid.stop_distance=2"}))) == 2.0);
  CHECK(stop_distance(must_load(robot_with("<param name='stop_distance' value='far'/>"),
                                with({"avoid.stop_distance=2 m"}))) == 2.0);
}

TEST_CASE("a parameter of a hardware is set like one of a component", "[graph][set]") {
  const Graph graph =
      must_load(robot_with(""), with({"robot.world=hall.world", "robot.realism=harsh"}), "/srv/graphs/g.xml");
  CHECK(std::get<std::string>(graph.hardware.at(0).params.at("realism")) == "harsh");
  CHECK(std::get<std::string>(graph.hardware.at(0).params.at("world")) ==
        (std::filesystem::current_path() / "hall.world").string());
}

TEST_CASE(
    "hardware keeps the parameters that the graph sets, even to a default; the others are its driver's "
    "affair",
    "[graph][set]") {
  const Graph graph = must_load(robot_with(""), with({"robot.realism=ideal"}));
  CHECK(graph.hardware.at(0).params.contains("realism"));
  CHECK_FALSE(graph.hardware.at(0).params.contains("robot"));
}

TEST_CASE("a parameter from the command line has precedence over the profiles", "[graph][set]") {
  const std::string text =
      "<graph name='g'><component name='l' type='orca.Label'/><profile name='loud'><component name='l'>"
      "<param name='label' value='profile'/></component></profile></graph>";
  const Graph graph = must_load(text, {{"loud"}, {"l.label=line.of=text"}});
  CHECK(std::get<std::string>(graph.components.at(0).params.at("label")) == "line.of=text");
}

TEST_CASE("a parameter in a sub-graph is set by the component's full name", "[graph][set]") {
  const Graph graph = must_load(kPair, with({"left/avoid.stop_distance=3 m"}));
  CHECK(stop_distance(graph, "left/avoid") == 3.0);
  CHECK(stop_distance(graph, "right/avoid") == 1.0);
}

TEST_CASE("a component that lacks its context in --set is found by the hint", "[graph][set]") {
  const std::string said = said_about(kPair, with({"avoid.stop_distance=3 m"}));
  CHECK(said.find("command line: error G014: --set avoid.stop_distance: ") == 0);
  CHECK(said.find("did you mean \"left/avoid\"?") != std::string::npos);
}

TEST_CASE("a name that only an unreadable file may hold is not reported as well", "[graph][set]") {
  const Files files{{"main.xml", "<graph name='g'><include file='lost.xml'/></graph>"}};
  CHECK(said_about(files, with({"avoid.stop_distance=3 m"})).find("G014") == std::string::npos);
}

TEST_CASE("a parameter cannot be set by a name that stands for two parts", "[graph][set]") {
  const std::string text =
      "<graph name='g'><hardware name='base' type='orca.hw.Sim'/>"
      "<component name='base' type='orca.RobotBaseServer' hardware='base'/></graph>";
  CHECK(said_about(text, with({"base.realism=harsh"})).find("G014: --set base.realism: ") !=
        std::string::npos);
}

TEST_CASE("what is set on the command line is printed as if the graph said it", "[graph][set]") {
  const Graph graph = must_load(robot_with(""), with({"avoid.stop_distance=2 m"}));
  CHECK(print(graph).find("<param name=\"stop_distance\" value=\"2\"/>") != std::string::npos);
  CHECK(must_load(print(graph)) == graph);
}
