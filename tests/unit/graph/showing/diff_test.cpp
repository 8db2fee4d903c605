// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/graph/diff.hpp"

#include "loading.hpp"
#include "orca/graph/print.hpp"

using namespace orca::graph;

namespace {

const std::string kStartWithEnds =
    "<graph name='g' ends='a b'><hardware name='robot' type='orca.hw.Sim'/>"
    "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>";

Graph graph_with(const std::string& content) {
  return must_load(kStartWithEnds +
                   "<component name='a' type='orca.Label'/><component name='b' type='orca.Label'/>" +
                   content + "</graph>");
}

const std::string kWiredAvoid =
    "<component name='avoid' type='orca.SonarAvoid'/>"
    "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>";

}  // namespace

TEST_CASE("a graph does not differ from itself, printed or not", "[graph][diff]") {
  const Graph graph = graph_with(kWiredAvoid);
  CHECK(diff(graph, graph).empty());
  CHECK(diff(graph, must_load(print(graph))).empty());
}

TEST_CASE("neither order nor the way of writing makes a difference", "[graph][diff]") {
  const Graph one = graph_with(
      "<arg name='d' default='600 mm'/><component name='avoid' type='orca.SonarAvoid' start_after='a b'>"
      "<param name='stop_distance' value='${d}'/></component>"
      "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>");
  const Graph other = must_load(
      "<graph name='g' ends='b, a' default_profile='sim'><connect from='base.SonarRangeReadingsPush' "
      "to='avoid.sonar' queue='3'/><component name='avoid' type='orca.SonarAvoid' start_after='b;a'>"
      "<param name='stop_distance' value='0.6'/></component><component name='b' type='orca.Label'/>"
      "<component name='a' type='orca.Label'/><component name='base' type='orca.RobotBaseServer' "
      "hardware='robot'/><profile name='sim'><hardware name='robot' type='orca.hw.Sim'/></profile></graph>");
  CHECK(diff_text(diff(one, other)).empty());
}

TEST_CASE("added and removed parts are listed by name", "[graph][diff]") {
  const auto changes = diff(graph_with(""), graph_with(kWiredAvoid));
  CHECK(diff_text(changes) == "+ component avoid\n+ connection base.SonarRangeReadingsPush to avoid.sonar\n");
  CHECK(diff_text(diff(graph_with(kWiredAvoid), graph_with(""))) ==
        "- component avoid\n- connection base.SonarRangeReadingsPush to avoid.sonar\n");
}

TEST_CASE("changes within a part are listed field by field, with both values", "[graph][diff]") {
  const Graph before = graph_with(kWiredAvoid);
  Graph after = before;
  after.supervision.restarts = 5;
  after.hardware[0].params["realism"] = std::string("harsh");
  after.components.back().params["stop_distance"] = 0.25;
  after.components.back().priority = 7;
  after.components.back().ports["odometry"].disabled = true;
  after.edges[0].queue.depth = 9;
  CHECK(diff_text(diff(before, after)) ==
        "~ graph\n    restarts: nothing -> 5\n"
        "~ hardware robot\n    param realism: ideal -> harsh\n"
        "~ component avoid\n    param stop_distance: 0.5 -> 0.25\n    port odometry: nothing -> "
        "disabled=\"true\"\n"
        "    priority: nothing -> 7\n"
        "~ connection base.SonarRangeReadingsPush to avoid.sonar\n    queue: 3 -> 9\n");
}

TEST_CASE("the difference in the other direction is the same with the values exchanged", "[graph][diff]") {
  const Graph before = graph_with(kWiredAvoid);
  const Graph after =
      graph_with("<component name='other' type='orca.Label'><param name='label' value='x'/></component>");
  const auto there = diff(before, after);
  const auto back = diff(after, before);
  REQUIRE(there.size() == back.size());
  for (std::size_t i = 0; i < there.size(); ++i) {
    CHECK(there[i].name == back[i].name);
    CHECK((there[i].kind == Change::Kind::added) == (back[i].kind == Change::Kind::removed));
  }
}

TEST_CASE("candidates belong to their port", "[graph][diff]") {
  const auto fuser = [](const std::string& candidates) {
    return graph_with(kWiredAvoid +
                      "<component name='fuser' type='orca.MotionCommandFuser'><port name='motion' "
                      "candidates='" +
                      candidates +
                      "'/></component><connect from='fuser.base' "
                      "to='base.MotionCommandSend'/>");
  };
  CHECK(diff_text(diff(fuser(""), fuser("avoid"))) ==
        "~ component fuser\n    port motion: nothing -> candidates=\"avoid.motion\"\n");
}

TEST_CASE("moving a component shows its process, its links and what is declared for them", "[graph][diff]") {
  const Graph together = graph_with(kWiredAvoid);
  const Graph apart = graph_with(
      "<process name='p' priority='9'/><component name='avoid' type='orca.SonarAvoid' process='p'/>"
      "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>");
  CHECK(diff_text(diff(together, apart)) ==
        "+ process p\n~ component avoid\n    process: nothing -> p\n"
        "~ connection base.SonarRangeReadingsPush to avoid.sonar\n    link: nothing -> shm\n");
  Graph hurried = apart;
  hurried.processes[0].priority = 20;
  hurried.supervision.restarts = 5;
  CHECK(diff_text(diff(apart, hurried)) ==
        "~ graph\n    restarts: nothing -> 5\n~ process p\n    priority: 9 -> 20\n");
}

TEST_CASE("a main process that is declared with the usual settings makes no difference", "[graph][diff]") {
  CHECK(diff(graph_with(""), graph_with("<process name='main'/>")).empty());
  CHECK(diff_text(diff(graph_with(""), graph_with("<process name='main' memory='1 GB'/>"))) ==
        "+ process main\n");
}

TEST_CASE("the JSON form holds the same", "[graph][diff]") {
  const Graph before = graph_with("");
  Graph after = before;
  after.components[1].priority = 2;
  CHECK(diff_json(diff(before, before)) == "[]\n");
  CHECK(diff_json(diff(before, after)) ==
        "[\n  {\n    \"kind\": \"changed\",\n    \"part\": \"component\",\n    \"name\": \"a\",\n"
        "    \"fields\": [\n      {\n        \"field\": \"priority\",\n        \"before\": \"\",\n"
        "        \"after\": \"2\"\n      }\n    ]\n  }\n]\n");
}
