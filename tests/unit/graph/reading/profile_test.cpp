// SPDX-License-Identifier: GPL-3.0-or-later
#include "loading.hpp"

using namespace orca;
using namespace orca::graph;
using Catch::Contains;

namespace {

const std::string kTwoRobots =
    "<graph name='g' default_profile='sim'>"
    "<component name='base' type='orca.RobotBaseServer' hardware='robot' period='20 ms'/>"
    "<component name='avoid' type='orca.SonarAvoid'><param name='stop_distance' value='1 m'/>"
    "<param name='rate' value='5 Hz'/></component>"
    "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>"
    "<profile name='sim'><hardware name='robot' type='orca.hw.Sim'/>"
    "  <component name='localizer' type='orca.Localizer'/></profile>"
    "<profile name='real'><hardware name='robot' type='orca.hw.NomadScout'/>"
    "  <component name='avoid' priority='5'><param name='stop_distance' value='2 m'/></component>"
    "  <connect from='base.SonarRangeReadingsPush' to='avoid.sonar' queue='7'/></profile>"
    "<profile name='slow'><component name='avoid'><param name='rate' value='1 Hz'/></component>"
    "  <component name='base' on='nothing'/></profile>"
    "</graph>";

double number(const Graph& graph, const char* component, const char* param) {
  return std::get<double>(graph.find_component(component)->params.at(param));
}

}  // namespace

TEST_CASE("without a choice the default profile is merged in", "[graph][profile]") {
  const Graph graph = must_load(kTwoRobots);
  CHECK(graph.find_hardware("robot")->type == "orca.hw.Sim");
  CHECK(graph.find_component("localizer") != nullptr);
  CHECK(number(graph, "avoid", "stop_distance") == 1.0);
}

TEST_CASE("a chosen profile takes the place of the default one", "[graph][profile]") {
  const Graph graph = must_load(kTwoRobots, {{"real"}, {}});
  CHECK(graph.find_hardware("robot")->type == "orca.hw.NomadScout");
  CHECK(graph.find_component("localizer") == nullptr);
}

TEST_CASE("a profile overrides single attributes and parameters and leaves the others", "[graph][profile]") {
  const Graph graph = must_load(kTwoRobots, {{"real"}, {}});
  CHECK(graph.find_component("avoid")->type == "orca.SonarAvoid");
  CHECK(graph.find_component("avoid")->priority == 5);
  CHECK(number(graph, "avoid", "stop_distance") == 2.0);
  CHECK(number(graph, "avoid", "rate") == 5.0);
}

TEST_CASE("a profile that repeats a connection sets its policy", "[graph][profile]") {
  const Graph graph = must_load(kTwoRobots, {{"real"}, {}});
  REQUIRE(graph.edges.size() == 1);
  CHECK(graph.edges[0].queue.depth == 7);
}

TEST_CASE("several profiles are merged in the order of the command line", "[graph][profile]") {
  const std::string text =
      "<graph name='g'><component name='a' type='orca.Localizer' priority='1'/>"
      "<profile name='x'><component name='a' priority='2' may_fail='true'/></profile>"
      "<profile name='y'><component name='a' priority='3'/></profile></graph>";
  CHECK(must_load(text, {{"x", "y"}, {}}).components.at(0).priority == 3);
  CHECK(must_load(text, {{"y", "x"}, {}}).components.at(0).priority == 2);
  CHECK(must_load(text, {{"x", "y"}, {}}).components.at(0).may_fail);
}

TEST_CASE("what is missing and stands in a profile that is not chosen is said to stand there",
          "[graph][profile]") {
  const LoadOptions slow{{"slow"}, {}};
  CHECK_THAT(
      said_about(kTwoRobots, slow),
      Contains("G034: component \"base\": there is no hardware \"robot\"; the graph has: nothing; it stands "
               "in the profile real or sim, which is not chosen: write --profile sim, or "
               "default_profile=\"sim\" in <graph>"));
  std::string wired = kTwoRobots;
  wired.replace(wired.find("base.Sonar"), 5, "localizer.");
  CHECK_THAT(said_about(wired, slow),
             Contains("there is no component \"localizer\"; it stands in the profile sim"));
  CHECK_THAT(said_about(kTwoRobots, {{"sim"}, {}}), !Contains("not chosen"));
}

TEST_CASE("another type starts with no parameters of the old one", "[graph][profile]") {
  const Graph graph = must_load(
      "<graph name='g'><hardware name='r' type='orca.hw.NomadScout'><param name='port' "
      "value='/dev/ttyS1'/></hardware>"
      "<profile name='sim'><hardware name='r' type='orca.hw.Sim'/></profile></graph>",
      {{"sim"}, {}});
  CHECK_FALSE(graph.hardware.at(0).params.contains("port"));
}

TEST_CASE("a profile's period takes the place of on, and the other way round", "[graph][profile]") {
  const std::string text =
      "<graph name='g'><component name='a' type='orca.Localizer' on='odometry'/>"
      "<component name='b' type='orca.Localizer' period='1 s'/>"
      "<profile name='p'><component name='a' period='2 s'/><component name='b' "
      "on='odometry'/></profile></graph>";
  const Graph graph = must_load(text, {{"p"}, {}});
  CHECK(graph.find_component("a")->trigger->kind == Trigger::Kind::period);
  CHECK(graph.find_component("b")->trigger->kind == Trigger::Kind::on_any);
}

TEST_CASE("hardware=\"\" in a profile takes the hardware away", "[graph][profile]") {
  const Graph graph = must_load(
      "<graph name='g'><component name='a' type='orca.RobotBaseServer' hardware='r'/>"
      "<profile name='p'><component name='a' type='orca.Localizer' hardware=''/></profile></graph>",
      {{"p"}, {}});
  CHECK(graph.components.at(0).hardware.empty());
}

TEST_CASE("a profile that is not chosen is checked for spelling, but not for content", "[graph][profile]") {
  const std::string text =
      "<graph name='g'><profile name='p'><component name='a' "
      "type='orca.Nothing'/><komponent/></profile></graph>";
  const std::string said = said_about(text);
  CHECK(said.find("G003") != std::string::npos);
  CHECK(said.find("G027") == std::string::npos);
}

TEST_CASE("a profile that is like no other is an error too, unless the file that may have it is missing",
          "[graph][profile]") {
  CHECK_THAT(said_about(kTwoRobots, {{"underwater"}, {}}),
             Contains("there is no profile \"underwater\"; the graph has: real, sim, slow"));
  const std::string with_missing =
      "<graph name='g'><include file='parts.xml'/><component name='a' type='orca.Localizer' "
      "autonomous='true'/>"
      "<profile name='sim'/></graph>";
  CHECK_THAT(said_about(with_missing, {{"underwater"}, {}}), !Contains("underwater"));
  CHECK_THAT(said_about(with_missing, {{"simm"}, {}}), Contains("there is no profile \"simm\""));
}
