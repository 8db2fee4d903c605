// SPDX-License-Identifier: GPL-3.0-or-later
// Sub-graphs under a prefix.
#include "loading.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

const std::string kArm =
    "<graph name='arm' ends='avoid'><arg name='distance' default='1 m'/>"
    "<hardware name='robot' type='orca.hw.Sim'/>"
    "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>"
    "<component name='avoid' type='orca.SonarAvoid' start_after='base'>"
    "<param name='stop_distance' value='${distance}'/></component>"
    "<component name='fuser' type='orca.MotionCommandFuser'><port name='motion' "
    "candidates='avoid'/></component>"
    "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>"
    "<connect from='fuser.base' to='base.MotionCommandSend'/>"
    "<profile name='slow'><component name='avoid'><param name='rate' value='1 Hz'/></component></profile>"
    "</graph>";

Graph with_arms(const std::string& content, const LoadOptions& options = {}) {
  return must_load(
      Files{{"main.xml", "<graph name='g'>" + content + "</graph>"},
            {"arm.xml", kArm},
            {"pair.xml",
             "<graph name='pair'><use graph='arm.xml' prefix='left'/>"
             "<include file='planner.xml'/></graph>"},
            {"planner.xml", "<graph name='p'><component name='planner' type='orca.Planner'/></graph>"}},
      options);
}

}  // namespace

TEST_CASE("a used graph has its names under the prefix, and its references follow", "[graph][use]") {
  const Graph graph = with_arms("<use graph='arm.xml' prefix='left'/>");
  REQUIRE(graph.find_component("left/avoid") != nullptr);
  CHECK(graph.hardware.at(0).name == "left/robot");
  CHECK(graph.find_component("left/base")->hardware == "left/robot");
  CHECK(graph.find_component("left/avoid")->start_after == std::vector<std::string>{"left/base"});
  CHECK(graph.edges.at(0).from.text() == "left/base.SonarRangeReadingsPush");
  CHECK(graph.edges.at(2).from.text() == "left/avoid.motion");
  CHECK(graph.edges.at(2).to.text() == "left/fuser.motion");
  CHECK(graph.ends.empty());
}

TEST_CASE("a graph can be used several times, with other arguments", "[graph][use]") {
  const Graph graph = with_arms(
      "<use graph='arm.xml' prefix='left'/><use graph='arm.xml' prefix='right'>"
      "<arg name='distance' value='2 m'/></use>");
  const auto distance = [&](const char* name) {
    return std::get<double>(graph.find_component(name)->params.at("stop_distance"));
  };
  CHECK(distance("left/avoid") == 1.0);
  CHECK(distance("right/avoid") == 2.0);
}

TEST_CASE("connections from outside use the prefixed names", "[graph][use]") {
  const Graph graph = with_arms(
      "<use graph='arm.xml' prefix='left'/><component name='planner' "
      "type='orca.Planner'/><connect from='planner.limits' to='left/base.LimitsQuery'/>");
  CHECK(graph.edges.size() == 4);
}

TEST_CASE("used graphs can use others: contexts add up", "[graph][use]") {
  const Graph graph = with_arms("<use graph='pair.xml' prefix='Platforms/Dewey'/>");
  CHECK(graph.find_component("Platforms/Dewey/left/avoid") != nullptr);
  CHECK(graph.find_component("Platforms/Dewey/planner") != nullptr);
}

TEST_CASE("the chosen profiles hold inside used graphs, and outside ones can override them", "[graph][use]") {
  const std::string content =
      "<use graph='arm.xml' prefix='left'/><profile name='slow'><component "
      "name='left/avoid'><param name='max_speed' value='0.1'/></component></profile>";
  const Graph graph = with_arms(content, {{"slow"}, {}});
  const Params& params = graph.find_component("left/avoid")->params;
  CHECK(std::get<double>(params.at("rate")) == 1.0);
  CHECK(std::get<double>(params.at("max_speed")) == 0.1);
}

TEST_CASE("a thousand used graphs load", "[graph][use]") {
  std::string content;
  for (int i = 0; i < 1000; ++i) content += "<use graph='arm.xml' prefix='r" + std::to_string(i) + "'/>";
  CHECK(with_arms(content).components.size() == 3000);
}
