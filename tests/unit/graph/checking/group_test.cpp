// SPDX-License-Identifier: GPL-3.0-or-later
// Groups as the reader and the checks understand them. Most of their errors are in tests/data/graphs/broken.
#include "loading.hpp"
#include "orca/graph/diff.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"

using namespace orca;
using namespace orca::graph;
using Catch::Contains;
using Names = std::vector<std::string>;

namespace {

// Two components, in two processes if the text of the second one says so.
std::string two(const std::string& content, const std::string& of_b = "") {
  return "<graph name='g'><component name='a' type='orca.Label'/><component name='b' type='orca.Label' " +
         of_b + "/>" + content + "</graph>";
}

}  // namespace

TEST_CASE("a group holds components of any processes, and a component may be in several", "[graph][group]") {
  const Graph graph = must_load(
      two("<process name='p'/><group name='all' components='b, a'/><group name='one' components='a'/>",
          "process='p'"));
  REQUIRE(graph.groups.size() == 2);
  CHECK(graph.find_group("all")->components == Names{"b", "a"});
  CHECK(graph.find_group("one")->components == Names{"a"});
  CHECK(graph.find_group("a") == nullptr);
}

TEST_CASE("a printed group loads again as the same, and programs get it too", "[graph][group]") {
  const Graph graph = must_load(two("<group name='all' components='b;a'/>"));
  CHECK_THAT(print(graph), Contains("  <group name=\"all\" components=\"b a\"/>\n"));
  CHECK(must_load(print(graph)) == graph);
  CHECK_THAT(graph_json(graph), Contains("\"groups\": [\n    {\n      \"name\": \"all\",\n"
                                         "      \"components\": \"b a\"\n    }\n  ]"));
}

TEST_CASE("the difference of two graphs has their groups, whose order of components means nothing",
          "[graph][group]") {
  const Graph before = must_load(two("<group name='all' components='a b'/>"));
  CHECK(diff(before, must_load(two("<group name='all' components='b a'/>"))).empty());
  CHECK(diff_text(diff(before, must_load(two("<group name='all' components='b'/>")))) ==
        "~ group all\n    components: a b -> b\n");
  CHECK(diff_text(diff(before, must_load(two("<group name='other' components='a'/>")))) ==
        "- group all\n+ group other\n");
}

TEST_CASE("a profile gives a group other components, or adds one", "[graph][group]") {
  const Graph graph =
      must_load(two("<group name='all' components='a b'/><profile name='p'><group name='all' components='b'/>"
                    "<group name='new' components='a'/></profile>"),
                {.profiles = {"p"}});
  REQUIRE(graph.groups.size() == 2);
  CHECK(graph.find_group("all")->components == Names{"b"});
  CHECK(graph.find_group("new")->components == Names{"a"});
}

TEST_CASE("the groups of a used graph have its prefix, those of an included one have not", "[graph][group]") {
  const Files files{{"main.xml",
                     "<graph name='g'><use graph='part.xml' prefix='left'/><include file='part.xml'/>"
                     "<group name='both' components='a left/a'/></graph>"},
                    {"part.xml",
                     "<graph name='p'><component name='a' type='orca.Label'/>"
                     "<group name='part' components='a'/></graph>"}};
  const Graph graph = must_load(files);
  CHECK(graph.find_group("left/part")->components == Names{"left/a"});
  CHECK(graph.find_group("part")->components == Names{"a"});
  CHECK(graph.find_group("both")->components == Names{"a", "left/a"});
}

TEST_CASE("a component that could not be read is missed in no group", "[graph][group]") {
  const std::string said = said_about(two("<componnt2 name='c'/><group name='all' components='a c'/>"));
  CHECK_THAT(said, Contains("componnt2") && !Contains("no component"));
}

TEST_CASE("what runs on one machine has the groups as far as they are there", "[graph][group]") {
  const Graph graph = must_load(two("<machine name='m'/><machine name='n'/><process name='main' machine='m'/>"
                                    "<process name='p' machine='n'/><group name='all' components='a b'/>"
                                    "<group name='there' components='b'/>",
                                    "process='p'"),
                                {.any_link = true});
  const Graph here = part_on(graph, "m");
  REQUIRE(here.groups.size() == 1);
  CHECK(here.find_group("all")->components == Names{"a"});
  CHECK(part_on(graph, "n").find_group("there")->components == Names{"b"});
}
