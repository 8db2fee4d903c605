// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <filesystem>
#include <numbers>

#include "loading.hpp"

using namespace orca;
using namespace orca::graph;

TEST_CASE("a graph without parts is a graph", "[graph][load]") {
  const Graph graph = must_load("<graph name='empty'/>");
  CHECK(graph.name == "empty");
  CHECK(graph.components.empty());
}

TEST_CASE("the attributes of the graph are read", "[graph][load]") {
  const Graph graph = must_load(
      "<graph name='g' version='1' ends='a, b' plugins='/opt/x;/opt/y/../z'>"
      "<component name='a' type='orca.Command'/><component name='b' type='orca.Command'/></graph>");
  CHECK(graph.ends == std::vector<std::string>{"a", "b"});
  CHECK(graph.plugin_dirs == std::vector<std::string>{"/opt/x", "/opt/z"});
}

TEST_CASE("parameters are complete: what the graph says in SI, and defaults", "[graph][load]") {
  const Graph graph =
      must_load(robot_with("<param name='stop_distance' value='190 mm'/>"
                           "<param name='sector' value='22.5 deg'/>"
                           "<param name='rate' value='5'/>"
                           "<param name='share' value='35 %'/>"
                           "<param name='samples' value='16'/>"
                           "<param name='verbose' value='true'/>"
                           "<param name='mode' value='creep'/>"
                           "<param name='zones' value='lab; north hall ;x'/>"));
  const Params& params = graph.find_component("avoid")->params;
  CHECK(std::get<double>(params.at("stop_distance")) == 0.19);
  CHECK(std::get<double>(params.at("sector")) == 22.5 * std::numbers::pi / 180.0);
  CHECK(std::get<double>(params.at("rate")) == 5.0);
  CHECK(std::get<double>(params.at("share")) == 0.35);
  CHECK(std::get<std::int64_t>(params.at("samples")) == 16);
  CHECK(std::get<bool>(params.at("verbose")));
  CHECK(std::get<std::string>(params.at("mode")) == "creep");
  CHECK(std::get<std::vector<std::string>>(params.at("zones")) ==
        std::vector<std::string>{"lab", "north hall", "x"});
  CHECK(std::get<double>(params.at("max_speed")) == 0.6);
  CHECK(params.size() == FakeCatalogue().component("orca.SonarAvoid", nullptr)->params.size());
}

TEST_CASE("the limits of a range are inside it", "[graph][load]") {
  const auto distance = [](const char* value) {
    const std::string text = "<param name='stop_distance' value='" + std::string(value) + "'/>";
    return std::get<double>(must_load(robot_with(text)).find_component("avoid")->params.at("stop_distance"));
  };
  CHECK(distance("50 mm") == 0.05);
  CHECK(distance("5 m") == 5.0);
}

TEST_CASE("a relative file starts at the folder of the graph, and the path is made plain", "[graph][load]") {
  const std::string text = robot_with("<param name='map' value='../maps/./hall.png'/>");
  const Graph graph = must_load(text, {}, "/srv/robots/graphs/hall.xml");
  CHECK(std::get<std::string>(graph.find_component("avoid")->params.at("map")) ==
        "/srv/robots/maps/hall.png");
}

TEST_CASE("a file parameter that nobody sets stays empty", "[graph][load]") {
  const Graph graph = must_load(robot_with(""));
  CHECK(std::get<std::string>(graph.find_component("avoid")->params.at("map")).empty());
}

TEST_CASE("how a component runs is set on it", "[graph][load]") {
  const Graph graph = must_load(
      "<graph name='g'>"
      "<component name='a' type='orca.Localizer' period='50 ms' priority='-3' autonomous='false' takes='20 "
      "ms'/>"
      "<component name='b' type='orca.Localizer' on='odometry' start_after='a' may_fail='true'/>"
      "<component name='c' type='orca.Localizer'/>"
      "<component name='base' type='orca.RobotBaseServer' hardware='h'/>"
      "<hardware name='h' type='orca.hw.Sim'><param name='world' value='hall'/></hardware>"
      "<component name='d' type='orca.SonarAvoid' on='sonar odometry' fuse='stamps' within='20 ms' "
      "at_least_every='1 s'/>"
      "<connect from='base.SonarRangeReadingsPush' to='d.sonar' queue='2'/></graph>");
  const ComponentNode& a = *graph.find_component("a");
  CHECK(a.trigger->kind == Trigger::Kind::period);
  CHECK(a.trigger->period == 50ms);
  CHECK(a.priority == -3);
  CHECK(a.autonomous == false);
  CHECK(a.takes == LapTime{{}, {0.02}});
  CHECK_FALSE(a.may_fail);
  const ComponentNode& b = *graph.find_component("b");
  CHECK(b.trigger->kind == Trigger::Kind::on_any);
  CHECK(b.trigger->ports == std::vector<std::string>{"odometry"});
  CHECK(b.start_after == std::vector<std::string>{"a"});
  CHECK(b.may_fail);
  const Trigger moments{Trigger::Kind::on_stamps, 1s, {"sonar", "odometry"}, 20ms};
  CHECK(graph.find_component("d")->trigger == moments);
  const ComponentNode& c = *graph.find_component("c");
  CHECK_FALSE(c.trigger.has_value());
  CHECK_FALSE(c.autonomous.has_value());
  CHECK(c.priority == 0);
  CHECK(c.takes == LapTime{});
}

TEST_CASE("an edge takes the receiver's policy where the graph says nothing", "[graph][load]") {
  const Graph graph = must_load(robot_with(""));
  const Edge& edge = graph.edges.at(0);
  CHECK(edge.from.text() == "base.SonarRangeReadingsPush");
  CHECK(edge.to.text() == "avoid.sonar");
  CHECK(edge.pattern == Pattern::push);
  CHECK(edge.queue.depth == 3);
  CHECK(edge.interval == 0s);
}

TEST_CASE("the integrator sets queue, overflow and interval of an edge", "[graph][load]") {
  const auto edge = [](const std::string& policy) {
    return must_load(
               "<graph name='g'><component name='a' type='orca.Localizer'/>"
               "<component name='b' type='orca.Goto'/>"
               "<connect from='a.pose' to='b.localizer' " +
               policy + "/></graph>")
        .edges.at(0);
  };
  CHECK(edge("queue='8' overflow='drop_newest'").queue ==
        QueuePolicy{.depth = 8, .overflow = QueuePolicy::Overflow::drop_newest, .drop_limit = 0});
  CHECK(edge("queue='latest'").queue == QueuePolicy{});
  CHECK(edge("interval='100 ms'").interval == 100ms);
  CHECK(edge("deadline='0.5 s'").queue.deadline == 500ms);
  const QueuePolicy blocking = edge("queue='2' overflow='block' block_limit='20 ms'").queue;
  CHECK(blocking.overflow == QueuePolicy::Overflow::block);
  CHECK(blocking.block_limit == 20ms);
  CHECK(edge("queue='2' overflow='block'").queue.block_limit == 100ms);
}

TEST_CASE("a queue may drop nothing and \"the latest\" any number, unless the graph sets a limit",
          "[graph][load]") {
  const auto drop_limit = [](const std::string& policy) {
    return must_load(
               "<graph name='g'><component name='a' type='orca.Localizer'/>"
               "<component name='b' type='orca.Goto'/>"
               "<connect from='a.pose' to='b.localizer' " +
               policy + "/></graph>")
        .edges.at(0)
        .queue.drop_limit;
  };
  CHECK(drop_limit("queue='latest'") == std::nullopt);
  CHECK(drop_limit("queue='1'") == std::nullopt);
  CHECK(drop_limit("queue='1' overflow='drop_newest'") == 0);
  CHECK(drop_limit("queue='2'") == 0);
  CHECK(drop_limit("queue='2' overflow='block'") == 0);
  CHECK(drop_limit("queue='2' drop_limit='30'") == 30);
  CHECK(drop_limit("queue='2' drop_limit=' any '") == QueuePolicy::kAnyDrops);
  CHECK(drop_limit("queue='latest' drop_limit='0'") == 0);
}

TEST_CASE("a Send connection refuses when it is full, or lets the sender wait", "[graph][load]") {
  const auto edge = [](const std::string& policy) {
    return must_load(
               "<graph name='g'><hardware name='h' type='orca.hw.Sim'><param name='world' "
               "value='w'/></hardware>"
               "<component name='base' type='orca.RobotBaseServer' hardware='h'/>"
               "<component name='fuser' type='orca.MotionCommandFuser'/>"
               "<connect from='fuser.base' to='base.MotionCommandSend' " +
               policy + "/></graph>")
        .edges.at(0);
  };
  CHECK(edge("").queue.overflow == QueuePolicy::Overflow::refuse);
  CHECK(edge("overflow='block' queue='3'").queue.overflow == QueuePolicy::Overflow::block);
  CHECK(edge("overflow='refuse' queue='3'").queue.depth == 3);
}

TEST_CASE("names may have contexts, and the last dot separates the port", "[graph][load]") {
  const Graph graph = must_load(
      "<graph name='g'><component name='Platforms/Dewey/loc' type='orca.Localizer'/>"
      "<component name='Platforms/Dewey/goto' type='orca.Goto'/>"
      "<connect from='Platforms/Dewey/loc.pose' to='Platforms/Dewey/goto.localizer'/></graph>");
  CHECK(graph.edges.at(0).from == PortRef{"Platforms/Dewey/loc", "pose"});
}

TEST_CASE("any number of edges may end at a port array", "[graph][load]") {
  const Graph graph = must_load(
      "<graph name='g'><component name='base' type='orca.RobotBaseServer' hardware='robot'/>"
      "<hardware name='robot' type='orca.hw.Sim'/><component name='fuser' type='orca.MotionCommandFuser'/>"
      "<component name='a' type='orca.SonarAvoid'/><component name='b' type='orca.SonarAvoid'/>"
      "<connect from='base.SonarRangeReadingsPush' to='a.sonar'/>"
      "<connect from='base.SonarRangeReadingsPush' to='b.sonar'/>"
      "<connect from='a.motion' to='fuser.motion'/><connect from='b.motion' to='fuser.motion'/></graph>");
  CHECK(graph.edges.size() == 4);
}

TEST_CASE("many proxies may send to one server", "[graph][load]") {
  CHECK(must_load(
            "<graph name='g'><component name='a' type='orca.MotionCommandFuser'/>"
            "<component name='b' type='orca.MotionCommandFuser'/><hardware name='robot' type='orca.hw.Sim'/>"
            "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>"
            "<connect from='a.base' to='base.MotionCommandSend'/>"
            "<connect from='b.base' to='base.MotionCommandSend'/></graph>")
            .edges.size() == 2);
}

TEST_CASE("the order of elements does not matter", "[graph][load]") {
  const Graph graph = must_load(
      "<graph name='g'><connect from='a.pose' to='b.localizer'/>"
      "<component name='b' type='orca.Goto'/><component name='a' type='orca.Localizer'/></graph>");
  CHECK(graph.edges.size() == 1);
}

TEST_CASE("nodes and edges remember where they stand", "[graph][load]") {
  const Graph graph = must_load("<graph name='g'>\n  <component name='a' type='orca.Localizer'/>\n</graph>");
  CHECK(graph.components.at(0).position.text() == "test.xml:2:3");
}

TEST_CASE("a graph file that is missing gives the reason", "[graph][load]") {
  FakeCatalogue catalogue;
  xml::Diagnostics diagnostics;
  CHECK_FALSE(load_file("no/such.xml", {}, catalogue, diagnostics));
  CHECK(diagnostics.text().find("no/such.xml:1:1: error G101") == 0);
}

TEST_CASE("the good graphs of the test data load from their files", "[graph][load]") {
  const auto folder = std::filesystem::path(ORCA_SOURCE_DIR) / "tests/data/graphs/good";
  int loaded = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    FakeCatalogue catalogue;
    xml::Diagnostics diagnostics;
    const bool good = load_file(entry.path().string(), {}, catalogue, diagnostics).has_value();
    INFO(diagnostics.text());
    CHECK(good);
    ++loaded;
  }
  CHECK(loaded >= 2);
}
