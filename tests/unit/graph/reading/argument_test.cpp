// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "loading.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

std::string label_of(const std::string& args, const std::string& value, const LoadOptions& options = {}) {
  const Graph graph = must_load("<graph name='g'>" + args + "<component name='avoid' type='orca.Label'>" +
                                    "<param name='label' value='" + value + "'/></component></graph>",
                                options);
  return std::get<std::string>(graph.components.at(0).params.at("label"));
}

}  // namespace

TEST_CASE("an argument is replaced by its default, or by what the command line sets", "[graph][arg]") {
  const std::string arg = "<arg name='who' default='Dewey'/>";
  CHECK(label_of(arg, "robot ${who}!") == "robot Dewey!");
  CHECK(label_of(arg, "${who}${who}") == "DeweyDewey");
  CHECK(label_of(arg, "${who}", {{}, {"who=Huey"}}) == "Huey");
  CHECK(label_of(arg, "${who}", {{}, {"who="}}).empty());
  CHECK(label_of(arg, "${who}", {{}, {"who=a=b"}}) == "a=b");
}

TEST_CASE("two dollars stand for one", "[graph][arg]") {
  CHECK(label_of("", "5 $$") == "5 $");
  CHECK(label_of("<arg name='a' default='x'/>", "$${a}${a}") == "${a}x");
}

TEST_CASE("a default may use the arguments before it", "[graph][arg]") {
  CHECK(label_of("<arg name='a' default='x'/><arg name='b' default='${a}y'/>", "${b}") == "xy");
}

TEST_CASE("each file knows the name of the system, unless it has an argument of its own that is called so",
          "[graph][arg]") {
  CHECK(label_of("", "I am ${system}") == "I am g");
  LoadOptions options;
  options.name = "anna";
  CHECK(label_of("", "I am ${system}", options) == "I am anna");
  CHECK(label_of("<arg name='system' default='x'/>", "${system}", options) == "x");
  const Graph graph = must_load(Files{
      {"main.xml", "<graph name='g'><use graph='robot.xml' prefix='dewey'/></graph>"},
      {"robot.xml",
       "<graph name='robot'><component name='a' type='orca.Label'><param name='label' value='${system}'/>"
       "</component></graph>"}});
  CHECK(std::get<std::string>(graph.components.at(0).params.at("label")) == "g");
}

TEST_CASE("an argument at the end of the file counts as well", "[graph][arg]") {
  const Graph graph = must_load(
      "<graph name='${n}'><component name='a' type='orca.Localizer' priority='${p}'/>"
      "<arg name='n' default='late'/><arg name='p' default='4'/></graph>");
  CHECK(graph.name == "late");
  CHECK(graph.components.at(0).priority == 4);
}

TEST_CASE("text that an argument brings in is not replaced again", "[graph][arg]") {
  CHECK(label_of("<arg name='a' default='$${b}'/>", "${a}") == "${b}");
}

TEST_CASE("a path from the command line starts at the current folder", "[graph][arg]") {
  const std::string text =
      "<graph name='g'><arg name='world' default='../a.world'/>"
      "<hardware name='r' type='orca.hw.Sim'><param name='world' value='${world}'/></hardware></graph>";
  const auto world = [&](const LoadOptions& options) {
    const Graph graph = must_load(text, options, "/srv/graphs/g.xml");
    return std::get<std::string>(graph.hardware.at(0).params.at("world"));
  };
  CHECK(world({}) == "/srv/a.world");
  CHECK(world({{}, {"world=maps/b.world"}}) == (std::filesystem::current_path() / "maps/b.world").string());
  CHECK(world({{}, {"world=/c.world"}}) == "/c.world");
}

TEST_CASE("an argument that nothing uses is a warning, and the graph loads", "[graph][arg]") {
  CHECK(said_about("<graph name='g'>\n<arg name='speed' default='1'/></graph>") ==
        "test.xml:2:1: warning G041: arg \"speed\" is used nowhere\n");
}
