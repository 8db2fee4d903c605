// SPDX-License-Identifier: GPL-3.0-or-later
// Graphs of several files.
#include <filesystem>

#include "loading.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

const std::string kRobot =
    "<graph name='robot'><arg name='distance' default='1 m'/>"
    "<hardware name='robot' type='orca.hw.Sim'><param name='world' value='hall.world'/></hardware>"
    "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>"
    "<component name='avoid' type='orca.SonarAvoid'><param name='stop_distance' value='${distance}'/>"
    "</component><connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/></graph>";

Graph with_robot(const std::string& content, const LoadOptions& options = {}) {
  return must_load(Files{{"main.xml", "<graph name='g'>" + content + "</graph>"}, {"robot.xml", kRobot}},
                   options);
}

}  // namespace

TEST_CASE("included elements count as if they stood in the file", "[graph][include]") {
  const Graph graph = with_robot(
      "<include file='robot.xml'/><component name='planner' type='orca.Planner'/>"
      "<connect from='planner.limits' to='base.LimitsQuery'/>");
  CHECK(graph.name == "g");
  CHECK(graph.components.size() == 3);
  CHECK(graph.edges.size() == 2);
}

TEST_CASE("parts stand in the order of the files", "[graph][include]") {
  const Graph graph = with_robot(
      "<component name='first' type='orca.Label'/><include file='robot.xml'/>"
      "<component name='last' type='orca.Label'/>");
  CHECK(graph.components.front().name == "first");
  CHECK(graph.components[1].name == "base");
  CHECK(graph.components.back().name == "last");
}

TEST_CASE("an include sets arguments of its file, which has its own", "[graph][include]") {
  CHECK(stop_distance(with_robot("<include file='robot.xml'/>")) == 1.0);
  CHECK(stop_distance(with_robot("<include file='robot.xml'><arg name='distance' value='2 m'/></include>")) ==
        2.0);
  CHECK(stop_distance(with_robot("<arg name='far' default='3 m'/><include file='robot.xml'>"
                                 "<arg name='distance' value='${far}'/></include>")) == 3.0);
  CHECK(stop_distance(with_robot("<arg name='distance' default='4 m'/><include file='robot.xml'/>"
                                 "<component name='l' type='orca.Label'><param name='label' "
                                 "value='${distance}'/></component>")) == 1.0);
}

TEST_CASE("--set is for the arguments of the file on the command line", "[graph][include]") {
  const std::string said = said_about(
      Files{{"main.xml", "<graph name='g'><include file='robot.xml'/></graph>"}, {"robot.xml", kRobot}},
      {{}, {"distance=2 m"}});
  CHECK(said.find("command line: error G014: --set distance") != std::string::npos);
}

TEST_CASE("paths start at the file that names them", "[graph][include]") {
  const std::string part =
      "<graph name='p'><arg name='map' default='own.map'/><component name='avoid' type='orca.Label'/>"
      "<hardware name='h' type='orca.hw.Sim'><param name='world' value='${map}'/></hardware></graph>";
  const auto world_of = [&](const std::string& content, const LoadOptions& options = {}) {
    const Graph graph = must_load(
        Files{{"main.xml", "<graph name='g'>" + content + "</graph>"}, {"parts/p.xml", part}}, options);
    return std::get<std::string>(graph.hardware.at(0).params.at("world"));
  };
  const std::string here = std::filesystem::current_path().string();
  CHECK(world_of("<include file='parts/p.xml'/>") == here + "/parts/own.map");
  CHECK(world_of("<include file='parts/p.xml'><arg name='map' value='my.map'/></include>") ==
        here + "/my.map");
  CHECK(world_of(
            "<arg name='m' default='x'/><include file='parts/p.xml'><arg name='map' value='${m}'/></include>",
            {{}, {"m=line.map"}}) == here + "/line.map");
}

TEST_CASE("an included file is found from the folder of the one that includes it", "[graph][include]") {
  const Files files{{"main.xml", "<graph name='g'><include file='a/b.xml'/></graph>"},
                    {"a/b.xml", "<graph name='b'><include file='../c/d.xml'/></graph>"},
                    {"c/d.xml", "<graph name='d'><component name='deep' type='orca.Label'/></graph>"}};
  CHECK(must_load(files).find_component("deep") != nullptr);
}

TEST_CASE("only the plugin folders of an included file's root element count", "[graph][include]") {
  const Graph graph = must_load(
      Files{{"main.xml",
             "<graph name='g' strategy='one_for_all' plugins='x'><include file='parts/p.xml'/></graph>"},
            {"parts/p.xml",
             "<graph name='p' strategy='rest_for_one' ends='a' plugins='y;../x'>"
             "<component name='a' type='orca.Label'/></graph>"}});
  const std::string here = std::filesystem::current_path().string();
  CHECK(graph.name == "g");
  CHECK(graph.supervision.strategy == Strategy::one_for_all);
  CHECK(graph.ends.empty());
  CHECK(graph.plugin_dirs == std::vector<std::string>{here + "/x", here + "/parts/y"});
}

TEST_CASE("profiles of one name in several files add up, the later overrides", "[graph][include]") {
  const Files files{
      {"main.xml",
       "<graph name='g' default_profile='sim'><include file='p.xml'/><profile name='sim'>"
       "<component name='a' priority='2'/></profile></graph>"},
      {"p.xml",
       "<graph name='p'><component name='a' type='orca.Localizer'/><profile name='sim'>"
       "<component name='a' priority='1' may_fail='true'/><component name='b' type='orca.Label'/>"
       "</profile><profile name='real'/></graph>"}};
  const Graph graph = must_load(files);
  CHECK(graph.find_component("a")->priority == 2);
  CHECK(graph.find_component("a")->may_fail);
  CHECK(graph.find_component("b") != nullptr);
  CHECK(must_load(files, {{"real"}, {}}).find_component("b") == nullptr);
}

TEST_CASE("a profile may include a file, and chooses that file's profiles too", "[graph][include]") {
  const Files files{
      {"main.xml", "<graph name='g'><profile name='sim'><include file='p.xml'/></profile></graph>"},
      {"p.xml",
       "<graph name='p'><component name='a' type='orca.Label'/><profile name='sim'>"
       "<component name='a' priority='1'/></profile><profile name='harsh'>"
       "<component name='a' priority='2'/></profile></graph>"}};
  CHECK(must_load(files).components.empty());
  CHECK(must_load(files, {{"sim"}, {}}).find_component("a")->priority == 1);
  CHECK(must_load(files, {{"sim", "harsh"}, {}}).find_component("a")->priority == 2);
}

TEST_CASE("a file may be included twice if its arguments make the names differ", "[graph][include]") {
  const Graph graph = must_load(Files{
      {"main.xml",
       "<graph name='g'><include file='p.xml'><arg name='n' value='1'/></include>"
       "<include file='p.xml'><arg name='n' value='2'/></include></graph>"},
      {"p.xml", "<graph name='p'><arg name='n'/><component name='cam${n}' type='orca.Label'/></graph>"}});
  CHECK(graph.components.size() == 2);
}

TEST_CASE("a file that is not there is said to be one of Orca's own, if it may be meant",
          "[graph][include]") {
  CHECK_THAT(
      said_about(Files{{"main.xml", "<graph name='g'><include file='graphs/scout_goto.xml'/></graph>"}}),
      Catch::Contains("; Orca's own is ") && Catch::Contains("/share/orca/graphs/scout_goto.xml"));
  CHECK_THAT(said_about(Files{{"main.xml", "<graph name='g'><include file='scout_goto.xml'/></graph>"}}),
             Catch::Contains("G043") && !Catch::Contains("Orca's own"));
}

TEST_CASE("errors in an included file stand at their place in it, once", "[graph][include]") {
  CHECK(said_about(Files{
            {"main.xml",
             "<graph name='g'>\n<use graph='parts/p.xml' prefix='a'/>\n"
             "<use graph='parts/p.xml' prefix='b'/>\n</graph>"},
            {"parts/p.xml", "<graph name='p'>\n<component name='x' type='orca.Nothing'/>\n</graph>"}}) ==
        "parts/p.xml:2:27: error G027: component \"a/x\": no plugin in plugins/ holds the type "
        "\"orca.Nothing\"\n");
}

TEST_CASE("parts of a file that cannot be read are not reported as missing", "[graph][include]") {
  const std::string said = said_about(
      Files{{"main.xml", "<graph name='g'><include file='p.xml'/><connect from='a.x' to='b.y'/></graph>"},
            {"p.xml", "<graph name='p'><component name='a' type='orca.Label'></graph>"}});
  CHECK(said.find("G111") != std::string::npos);
  CHECK(said.find("G016") == std::string::npos);
}

TEST_CASE("a chain of more than fifty files is refused, one of forty is not", "[graph][include]") {
  const auto chain = [](int length) {
    Files files;
    for (int i = 0; i < length; ++i)
      files[i == 0 ? "main.xml" : "f" + std::to_string(i) + ".xml"] =
          "<graph name='g'><include file='f" + std::to_string(i + 1) + ".xml'/></graph>";
    files["f" + std::to_string(length) + ".xml"] = "<graph name='g'/>";
    return files;
  };
  CHECK(said_about(chain(40)).empty());
  const std::string said = said_about(chain(60));
  INFO(said);
  CHECK(said.find("f49.xml:1:32: error G045") == 0);
  CHECK(
      said.find("more than 50 files deep (this file is included at f48.xml:1:17, included at f47.xml:1:17") !=
      std::string::npos);
}
