// SPDX-License-Identifier: GPL-3.0-or-later
// Which component serves which robot.
#include "orca/host/robot_finder.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::host;

namespace {

// A graph of hardware, components "name" or "name@hardware", and connections "from to".
graph::Graph graph_of(const std::vector<std::string>& hardware, const std::vector<std::string>& components,
                      const std::vector<std::pair<std::string, std::string>>& edges) {
  graph::Graph graph;
  for (const std::string& name : hardware) graph.hardware.emplace_back().name = name;
  for (const std::string& text : components) {
    graph::ComponentNode& node = graph.components.emplace_back();
    const std::size_t at = text.find('@');
    node.name = text.substr(0, at);
    if (at != std::string::npos) node.hardware = text.substr(at + 1);
  }
  for (const auto& [from, to] : edges) {
    graph::Edge& edge = graph.edges.emplace_back();
    edge.from = {from, "out"};
    edge.to = {to, "in"};
  }
  return graph;
}

}  // namespace

TEST_CASE("a component serves the robot that is the fewest connections away", "[host][robots]") {
  const graph::Graph graph =
      graph_of({"scout", "pioneer"}, {"base_1@scout", "goto_1", "command", "goto_2", "base_2@pioneer"},
               {{"base_1", "goto_1"}, {"command", "goto_1"}, {"command", "goto_2"}, {"goto_2", "base_2"}});
  const RobotNames names = find_robots(graph, {{"scout", "Dewey"}, {"pioneer", "Huey"}});
  CHECK(names.robots == std::vector<std::string>{"Dewey", "Huey"});
  CHECK(names.several());
  CHECK(names.of("base_1") == "Dewey");
  CHECK(names.of("goto_1") == "Dewey");
  CHECK(names.of("goto_2") == "Huey");
  CHECK(names.of("command").empty());  // as near to one as to the other
}

TEST_CASE("what lies beyond a component of several robots is nobody's, unless another way leads to one",
          "[host][robots]") {
  const graph::Graph graph = graph_of({"one", "two"}, {"a@one", "b@two", "shared", "log", "far"},
                                      {{"a", "shared"},
                                       {"b", "shared"},
                                       {"shared", "log"},
                                       {"shared", "far"},
                                       {"log", "far"},
                                       {"x", "far"},
                                       {"a", "y"},
                                       {"y", "x"}});
  const RobotNames names = find_robots(graph, {{"one", "A"}, {"two", "B"}});
  CHECK(names.of("shared").empty());
  CHECK(names.of("far") == "A");
  CHECK(names.of("log") == "A");
}

TEST_CASE(
    "hardware that moves nothing is no robot, and its components serve the robot that they are wired to",
    "[host][robots]") {
  const graph::Graph graph = graph_of({"base", "sick"}, {"motors@base", "laser@sick", "avoid"},
                                      {{"laser", "avoid"}, {"avoid", "motors"}});
  const RobotNames names = find_robots(graph, {{"base", "Dewey"}});
  CHECK_FALSE(names.several());
  CHECK(names.of("laser") == "Dewey");
  CHECK(names.of("avoid") == "Dewey");
}

TEST_CASE("a component without a connection, and one of another name, serve nobody", "[host][robots]") {
  const RobotNames names = find_robots(graph_of({"base"}, {"motors@base", "log"}, {}), {{"base", "Dewey"}});
  CHECK(names.of("motors") == "Dewey");
  CHECK(names.of("log").empty());
  CHECK(names.of("no_such").empty());
}
