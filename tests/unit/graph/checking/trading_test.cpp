// SPDX-License-Identifier: GPL-3.0-or-later
// What a graph's ports seek by the properties of components, and what is found. The errors are in
// tests/data/graphs/broken/trade_*.xml.
#include <algorithm>

#include "loading.hpp"
#include "orca/graph/diff.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/graph/print.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

std::string localizer(const std::string& name, const std::string& properties = "",
                      const std::string& attributes = "") {
  return "<component name='" + name + "' type='orca.Localizer' " + attributes + ">" + properties +
         "</component>";
}

std::string property(const std::string& name, const std::string& value) {
  return "<property name='" + name + "' value=\"" + value + "\"/>";
}

// Two localizers, the second of which is better, and a Goto that seeks one.
std::string two_localizers(const std::string& seek) {
  return "<graph name='g'>" + localizer("coarse", property("accuracy", "0.5 m") + property("room", "hall")) +
         localizer("fine", property("accuracy", "5 cm") + property("tested", "true")) +
         "<component name='goto' type='orca.Goto'/><connect to='goto.localizer' " + seek + "/></graph>";
}

// Returns the servers of an edge with a choice, in the order of choice: "fine.pose coarse.pose".
std::string choices_in(const Graph& graph) {
  std::vector<const Edge*> edges;
  for (const Edge& edge : graph.edges)
    if (edge.choice > 0) edges.push_back(&edge);
  std::ranges::sort(edges, {}, &Edge::choice);
  std::string text;
  for (const Edge* edge : edges) text += (text.empty() ? "" : " ") + edge->server().text();
  return text;
}

std::string sought(const std::string& seek) { return choices_in(must_load(two_localizers(seek))); }

}  // namespace

TEST_CASE("properties are flags, numbers in SI and texts", "[graph][trading]") {
  const Graph graph =
      must_load("<graph name='g'>" +
                localizer("a", property("accuracy", "50 mm") + property("share", "20 %") +
                                   property("tested", "true") + property("room", "  hall of fame ") +
                                   property("label", "'4 m'") + property("rank", "2")) +
                "</graph>");
  const Properties& properties = graph.find_component("a")->properties;
  CHECK(properties.at("accuracy") == PropertyValue(Quantity{0.05, "m"}));
  CHECK(properties.at("share") == PropertyValue(Quantity{0.2, ""}));
  CHECK(properties.at("rank") == PropertyValue(Quantity{2.0, ""}));
  CHECK(properties.at("tested") == PropertyValue(true));
  CHECK(properties.at("room") == PropertyValue(std::string("hall of fame")));
  CHECK(properties.at("label") == PropertyValue(std::string("4 m")));
}

TEST_CASE("a profile overrides a property, and adds others", "[graph][trading]") {
  const Graph graph =
      must_load("<graph name='g' default_profile='p'>" + localizer("a", property("room", "hall")) +
                "<profile name='p'><component name='a'>" + property("room", "kitchen") + property("x", "1") +
                "</component></profile></graph>");
  CHECK(graph.find_component("a")->properties.at("room") == PropertyValue(std::string("kitchen")));
  CHECK(graph.find_component("a")->properties.size() == 2);
}

TEST_CASE("a port that seeks has one connection to each component that fits", "[graph][trading]") {
  const Graph graph = must_load(two_localizers("seek=\"accuracy &lt;= 1 m\""));
  CHECK(choices_in(graph) == "coarse.pose fine.pose");
  REQUIRE(graph.edges.size() == 2);
  CHECK(graph.edges[0].client() == PortRef{"goto", "localizer"});
  CHECK(sought("seek=\"accuracy &lt;= 0.1 m\"") == "fine.pose");
}

TEST_CASE("a component without the property does not fit", "[graph][trading]") {
  CHECK(sought("seek=\"room != 'kitchen'\"") == "coarse.pose");
  CHECK(sought("seek='tested == true'") == "fine.pose");
}

TEST_CASE("type, name, process and machine are properties of each component", "[graph][trading]") {
  CHECK(sought("seek=\"type == 'orca.Localizer'\"") == "coarse.pose fine.pose");
  CHECK(sought("seek=\"name == 'fine'\"") == "fine.pose");
  CHECK(sought("seek=\"process == 'main'; name != 'fine'\"") == "coarse.pose");
  const std::string places =
      "<machine name='m1'/><machine name='m2'/><process name='p1' machine='m1'/><process name='p2' "
      "machine='m2'/>";
  const Graph graph = must_load("<graph name='g'>" + places + localizer("a", "", "process='p1'") +
                                localizer("b", "", "process='p2'") +
                                "<component name='goto' type='orca.Goto' process='p1'/>"
                                "<connect to='goto.localizer' seek=\"machine == 'm2'\"/></graph>");
  CHECK(choices_in(graph) == "b.pose");
  CHECK(graph.edges.front().link == Link::dds);
}

TEST_CASE("the preferred component comes first, those without the property last", "[graph][trading]") {
  const std::string any = "seek=\"type == 'orca.Localizer'\"";
  CHECK(sought(any + " prefer='min accuracy'") == "fine.pose coarse.pose");
  CHECK(sought(any + " prefer='max accuracy'") == "coarse.pose fine.pose");
  const Graph graph = must_load(
      "<graph name='g'>" + localizer("none") + localizer("low", property("q", "1")) + localizer("none2") +
      localizer("high", property("q", "2")) + localizer("high2", property("q", "2")) +
      "<component name='goto' type='orca.Goto'/><connect to='goto.localizer' " + any +
      " prefer='max q'/></graph>");
  CHECK(choices_in(graph) == "high.pose high2.pose low.pose none.pose none2.pose");
}

TEST_CASE("the policy holds for each of the connections", "[graph][trading]") {
  const Graph graph = must_load(two_localizers("seek=\"accuracy &lt;= 1 m\" queue='7' interval='1 s'"));
  for (const Edge& edge : graph.edges) {
    CHECK(edge.queue.depth == 7);
    CHECK(edge.interval == std::chrono::seconds(1));
  }
}

TEST_CASE("each connection has the link between its own processes", "[graph][trading]") {
  const Graph graph = must_load("<graph name='g'><process name='p'/>" + localizer("near") +
                                localizer("far", "", "process='p'") +
                                "<component name='goto' type='orca.Goto'/>"
                                "<connect to='goto.localizer' seek=\"type == 'orca.Localizer'\"/></graph>");
  CHECK(graph.edges.at(0).link == Link::local);
  CHECK(graph.edges.at(1).link == Link::shm);
}

TEST_CASE("what asks or sends seeks by its from", "[graph][trading]") {
  const Graph graph = must_load(
      "<graph name='g'><hardware name='h' type='orca.hw.Sim'/>"
      "<component name='base' type='orca.RobotBaseServer' hardware='h'/>"
      "<component name='planner' type='orca.Planner'/><component name='fuser' "
      "type='orca.MotionCommandFuser'/>"
      "<connect from='planner.limits' seek=\"name == 'base'\"/>"
      "<connect from='fuser.base' seek=\"type == 'orca.RobotBaseServer'\" confirm='handled'/></graph>");
  CHECK(graph.edges.at(0).to == PortRef{"base", "LimitsQuery"});
  CHECK(graph.edges.at(1).to == PortRef{"base", "MotionCommandSend"});
  CHECK(graph.edges.at(1).client() == PortRef{"fuser", "base"});
}

TEST_CASE("candidates of a port array may be sought", "[graph][trading]") {
  const Graph graph = must_load(
      "<graph name='g'><component name='fuser' type='orca.MotionCommandFuser'>"
      "<port name='motion' candidates=\"kind == 'behaviour'\"/></component>"
      "<component name='a' type='orca.SonarAvoid'>" +
      property("kind", "behaviour") +
      "</component>"
      "<component name='b' type='orca.SonarAvoid'/><component name='c' type='orca.Goto'>" +
      property("kind", "behaviour") + "</component>" + localizer("l") +
      "<hardware name='h' type='orca.hw.Sim'/><component name='base' type='orca.RobotBaseServer' "
      "hardware='h'/>"
      "<connect from='base.SonarRangeReadingsPush' to='a.sonar'/>"
      "<connect from='base.SonarRangeReadingsPush' to='b.sonar'/><connect from='l.pose' "
      "to='c.localizer'/></graph>");
  const auto& candidates = graph.find_component("fuser")->ports.at("motion").candidates;
  CHECK(candidates == std::vector<PortRef>{{"a", "motion"}, {"c", "MotionPush"}});
  CHECK(must_load(print(graph)) == graph);
}

TEST_CASE("a sub-graph seeks among its own components, by the names that it knows", "[graph][trading]") {
  const Files files{
      {"main.xml",
       "<graph name='g'><use graph='robot.xml' prefix='huey'/><use graph='robot.xml' prefix='dewey'/>" +
           localizer("fine", property("accuracy", "1 mm")) + "</graph>"},
      {"robot.xml",
       "<graph name='robot'>" + localizer("fine", property("accuracy", "1 cm")) +
           "<component name='goto' type='orca.Goto'/>"
           "<connect to='goto.localizer' seek=\"name == 'fine'; accuracy &lt;= 1 m\"/></graph>"}};
  const Graph graph = must_load(files);
  REQUIRE(graph.edges.size() == 2);
  CHECK(graph.edges[0].from == PortRef{"huey/fine", "pose"});
  CHECK(graph.edges[1].from == PortRef{"dewey/fine", "pose"});
}

TEST_CASE("choices may be written one by one", "[graph][trading]") {
  const Graph graph = must_load("<graph name='g'>" + localizer("a") + localizer("b") +
                                "<component name='goto' type='orca.Goto'/>"
                                "<connect from='a.pose' to='goto.localizer' choice='2'/>"
                                "<connect from='b.pose' to='goto.localizer' choice='1'/></graph>");
  CHECK(choices_in(graph) == "b.pose a.pose");
}

TEST_CASE("a printed trade reads back as the choices that were found", "[graph][trading]") {
  const Graph graph = must_load(two_localizers("seek=\"accuracy &lt;= 1 m\" prefer='min accuracy'"));
  CHECK(print(graph).find("seek") == std::string::npos);
  CHECK(print(graph).find("<connect from=\"fine.pose\" to=\"goto.localizer\"") != std::string::npos);
  CHECK(print(graph).find("choice=\"1\"") != std::string::npos);
  CHECK(print(graph).find("<property name=\"accuracy\" value=\"0.05 m\"/>") != std::string::npos);
  CHECK(must_load(print(graph)) == graph);
}

TEST_CASE("a changed property and a changed choice are differences", "[graph][trading]") {
  const Graph before = must_load(two_localizers("seek=\"accuracy &lt;= 1 m\" prefer='min accuracy'"));
  Graph after = before;
  after.components[0].properties["accuracy"] = Quantity{1.0, "m"};
  after.edges[0].choice = 3;
  const std::string text = diff_text(diff(before, after));
  CHECK(text.find("property accuracy: 0.5 m -> 1 m") != std::string::npos);
  CHECK(text.find("choice: 1 -> 3") != std::string::npos);
}

TEST_CASE("pictures, lists and JSON show the choices", "[graph][trading]") {
  FakeCatalogue catalogue;
  const Graph graph = must_load(two_localizers("seek=\"accuracy &lt;= 1 m\" prefer='min accuracy'"));
  CHECK(dot(graph, "").find("pose > localizer (choice 2)") != std::string::npos);
  const auto ports = list_ports(graph, catalogue);
  CHECK(ports_text(ports).find("from fine.pose (choice 1), coarse.pose (choice 2)") != std::string::npos);
  CHECK(ports_json(ports).find("\"choices\"") != std::string::npos);
  CHECK(graph_json(graph).find("\"accuracy\": 0.05") != std::string::npos);
}

TEST_CASE("of a running system, a list of ports shows which choice is in use", "[graph][trading]") {
  FakeCatalogue catalogue;
  const Graph graph = must_load(two_localizers("seek=\"accuracy &lt;= 1 m\" prefer='min accuracy'"));
  auto ports = list_ports(graph, catalogue);
  mark_in_use(ports, {&graph.edges.at(1)});
  CHECK(ports_text(ports).find("from fine.pose (choice 1), coarse.pose (choice 2, in use)") !=
        std::string::npos);
  CHECK(ports_text(ports).find("to goto.localizer (choice 2, in use)") != std::string::npos);
}
