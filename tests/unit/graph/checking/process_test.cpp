// SPDX-License-Identifier: GPL-3.0-or-later
// Processes, machines and links as the reader and the checks understand them. Their errors are in
// tests/data/graphs/broken.
#include "loading.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

// A base, an avoider and a fuser; the texts are further attributes.
std::string robot_in_processes(const std::string& declarations, const std::string& base,
                               const std::string& avoid, const std::string& fuser,
                               const std::string& connect = "") {
  return "<graph name='g'>" + declarations +
         "<hardware name='robot' type='orca.hw.Sim'/>"
         "<component name='base' type='orca.RobotBaseServer' hardware='robot' " +
         base + "/><component name='avoid' type='orca.SonarAvoid' " + avoid +
         "/><component name='fuser' type='orca.MotionCommandFuser' " + fuser +
         "/><connect from='base.SonarRangeReadingsPush' to='avoid.sonar' " + connect +
         "/><connect from='avoid.motion' to='fuser.motion'/>"
         "<connect from='fuser.base' to='base.MotionCommandSend'/></graph>";
}

std::vector<Link> links_of(const Graph& graph) {
  std::vector<Link> links;
  for (const Edge& edge : graph.edges) links.push_back(edge.link);
  return links;
}

const std::string kTwo = "<process name='a'/><process name='b'/>";
const std::string kTwoMachines = "<machine name='m'/><machine name='n'/>";
}  // namespace

TEST_CASE("the attributes of a process are read, in SI", "[graph][process]") {
  const Graph graph = must_load(robot_in_processes(
      "<machine name='m'/><process name='a' machine='m' executor='fiber' spin='50 us' processors='0 3, 1;3' "
      "cores='2' "
      "priority='10' lock_memory='true' memory='200 MB' restart='transient' hang_limit='0.2 s' text='x'/>"
      "<process name='main' machine='m'/>",
      "process='a'", "", ""));
  ProcessNode expected{.name = "a", .machine = "m", .executor = Backend::fiber, .spin = 50us};
  expected.processors = {0, 3, 1};
  expected.cores = 2;
  expected.priority = 10;
  expected.lock_memory = true;
  expected.memory = 200'000'000;
  expected.restart = Restart::transient;
  expected.hang_limit = 200ms;
  REQUIRE(graph.processes.size() == 2);
  CHECK(graph.processes[0] == expected);
  CHECK(graph.processes[1] == ProcessNode{.name = "main", .machine = "m"});
}

TEST_CASE("a process that says nothing has threads, no limits and is started again after any end",
          "[graph][process]") {
  const ProcessNode plain =
      must_load(robot_in_processes(kTwo, "process='a'", "process='b'", "")).processes.at(0);
  CHECK(plain == ProcessNode{.name = "a"});
  CHECK(plain.executor == Backend::thread);
  CHECK(plain.restart == Restart::permanent);
  CHECK(plain.hang_limit == 500ms);
  CHECK_FALSE(plain.priority);
  CHECK_FALSE(plain.memory);
  CHECK(plain.cores == 0);
  CHECK(plain.delay == 0s);
}

TEST_CASE("a connection takes the delays of its two processes, and none within one", "[graph][process]") {
  const Graph graph = must_load(robot_in_processes(
      "<process name='a' delay='3 ms'/><process name='b' delay='4 ms'/>", "process='a'", "process='b'", ""));
  const auto delay_between = [&](const std::string& from, const std::string& to) {
    Edge edge;
    edge.from.component = from;
    edge.to.component = to;
    return delay_of(graph, edge);
  };
  CHECK(delay_between("base", "avoid") == 7ms);
  CHECK(delay_between("avoid", "base") == 7ms);
  CHECK(delay_between("fuser", "avoid") == 4ms);
  CHECK(delay_between("base", "base") == 0s);
  CHECK(said_about(robot_in_processes("<process name='a' delay='-1 ms'/>", "", "process='a'", ""))
            .find("delay") != std::string::npos);
}

TEST_CASE("a process that is started on demand ends after 10 s without use unless the graph says otherwise",
          "[graph][process]") {
  const auto avoid_in = [](const std::string& attributes) {
    const Graph graph = must_load(robot_in_processes(
        "<process name='a' start='on_demand' " + attributes + "/>", "", "process='a'", ""));
    REQUIRE(graph.processes.size() == 1);
    CHECK(graph.processes[0].on_demand);
    CHECK(must_load(print(graph)) == graph);
    return graph.processes[0].idle_time;
  };
  CHECK(avoid_in("") == 10s);
  CHECK(avoid_in("idle_time='0.5 s'") == 500ms);
  CHECK(avoid_in("stay='warm'") == 0s);
}

TEST_CASE("a connection over DDS cannot wake a process, but one from it can be of any kind",
          "[graph][process]") {
  const std::string process = "<process name='a' start='on_demand'/>";
  const std::string here = "process='a'";
  CHECK(must_load(robot_in_processes(process, "", here, "", "link='dds'")).edges[0].link == Link::dds);
  const std::string said = said_about(robot_in_processes(process, "", here, here, "link='dds'"));
  CHECK(said.find("no other process uses anything in it") != std::string::npos);
}

TEST_CASE("the attributes of a machine are read", "[graph][process]") {
  const Graph graph =
      must_load(robot_in_processes("<machine name='m' address='10.0.0.2' interface='wlan0' on_loss='go_on' "
                                   "loss_limit='2.5 s' delay='20 ms'/>"
                                   "<machine name='n'/><process name='main' machine='m'/>",
                                   "", "", ""));
  REQUIRE(graph.machines.size() == 2);
  MachineNode expected{.name = "m", .address = "10.0.0.2", .interface = "wlan0"};
  CHECK(graph.machines[0] != expected);
  expected.on_loss = OnLoss::go_on;
  CHECK(graph.machines[0] != expected);
  expected.loss_limit = 2500ms;
  CHECK(graph.machines[0] != expected);
  expected.delay = 20ms;
  CHECK(graph.machines[0] == expected);
  CHECK(graph.machines[1] == MachineNode{.name = "n"});
}

TEST_CASE("the rules for restarts are those of the graph, or the usual ones", "[graph][process]") {
  CHECK(must_load("<graph name='g'/>").supervision == Supervision{});
  const Supervision read = must_load(
                               "<graph name='g' strategy='rest_for_one' restarts='5' within='1 min' "
                               "on_supervisor_loss='continue' machine_wait='5 s' adoption_wait='1 min'/>")
                               .supervision;
  CHECK(read == Supervision{Strategy::rest_for_one, 5, 60s, OnLoss::go_on, 5s, 60s});
  CHECK(must_load("<graph name='g' strategy='one_for_all'/>").supervision.strategy == Strategy::one_for_all);
}

TEST_CASE("a component that names no process is in main, and hardware is where its components are",
          "[graph][process]") {
  const Graph graph = must_load(robot_in_processes(kTwo, "process='a'", "process='b'", ""));
  CHECK(graph.find_component("base")->process == "a");
  CHECK(graph.find_component("avoid")->process == "b");
  CHECK(graph.find_component("fuser")->process == "main");
  CHECK(graph.find_hardware("robot")->process == "a");
  CHECK(processes_of(graph).size() == 3);
  CHECK(part_of(graph, "a").hardware == std::vector<std::string>{"robot"});
}

TEST_CASE("hardware without components is in main", "[graph][process]") {
  const Graph graph = must_load("<graph name='g'><hardware name='h' type='orca.hw.Sim'/></graph>");
  CHECK(graph.hardware.at(0).process == "main");
}

TEST_CASE("an edge is local within a process and uses shared memory between two", "[graph][process]") {
  CHECK(links_of(must_load(robot_in_processes("", "", "", ""))) ==
        std::vector{Link::local, Link::local, Link::local});
  CHECK(links_of(must_load(robot_in_processes(kTwo, "process='a'", "process='b'", "process='b'"))) ==
        std::vector{Link::shm, Link::local, Link::shm});
}

TEST_CASE("an edge between machines goes over the network", "[graph][process]") {
  const std::string places = kTwoMachines +
                             "<process name='a' machine='m'/><process name='b' machine='n'/>"
                             "<process name='main' machine='n'/>";
  CHECK(links_of(must_load(robot_in_processes(places, "process='a'", "process='b'", ""), kAnyLink)) ==
        std::vector{Link::dds, Link::shm, Link::dds});
}

TEST_CASE("the graph may choose the link where it fits", "[graph][process]") {
  const auto first_link = [](const std::string& avoid, const std::string& link) {
    return must_load(robot_in_processes(kTwo, "process='a'", avoid, "", "link='" + link + "'"), kAnyLink)
        .edges.at(0)
        .link;
  };
  CHECK(first_link("process='a'", "local") == Link::local);
  CHECK(first_link("process='b'", "shm") == Link::shm);
  CHECK(first_link("process='b'", "dds") == Link::dds);
  CHECK(first_link("process='a'", "dds") == Link::dds);
}

TEST_CASE("an edge to a candidate has a link, too", "[graph][process]") {
  const Graph graph = must_load(
      "<graph name='g'><process name='a'/><component name='loc' type='orca.TwinGoto' process='a'/>"
      "<component name='fuser' type='orca.MotionCommandFuser'><port name='motion' candidates='loc.slow'/>"
      "</component></graph>");
  REQUIRE(graph.edges.size() == 1);
  CHECK(graph.edges[0].late_bound);
  CHECK(graph.edges[0].link == Link::shm);
}

TEST_CASE("a profile moves components and changes processes", "[graph][process][profile]") {
  const Graph graph = must_load(
      "<graph name='g' default_profile='far'><process name='a' priority='3' memory='1 GB'/>"
      "<component name='c' type='orca.Localizer' process='a'/><component name='d' type='orca.Localizer'/>"
      "<profile name='far'><process name='a' priority='5'/><process name='b'/>"
      "<component name='d' process='b'/><component name='c' process=''/></profile>"
      "<component name='e' type='orca.Localizer' process='a'/></graph>");
  CHECK(graph.find_component("c")->process == "main");
  CHECK(graph.find_component("d")->process == "b");
  REQUIRE(graph.processes.size() == 2);
  CHECK(graph.processes[0].priority == 5);
  CHECK(graph.processes[0].memory == 1'000'000'000);
}

TEST_CASE("a used graph has its own processes and machines, but main is one for all",
          "[graph][process][use]") {
  const Files files{{"main.xml",
                     "<graph name='g'><machine name='m'/><process name='main' machine='m'/>"
                     "<use graph='part.xml' prefix='left'/><use graph='part.xml' prefix='right'/></graph>"},
                    {"part.xml",
                     "<graph name='p'><machine name='m'/><process name='a' machine='m'/>"
                     "<component name='c' type='orca.Localizer' process='a'/>"
                     "<component name='d' type='orca.Localizer' process='main'/>"
                     "<component name='e' type='orca.Localizer'/></graph>"}};
  const Graph graph = must_load(files);
  CHECK(graph.find_component("left/c")->process == "left/a");
  CHECK(graph.find_component("right/c")->process == "right/a");
  CHECK(graph.find_component("left/d")->process == "main");
  CHECK(graph.find_component("right/e")->process == "main");
  REQUIRE(processes_of(graph).size() == 3);
  CHECK(graph.processes.at(1).machine == "left/m");
}

TEST_CASE("a process that could not be read causes no further errors", "[graph][process]") {
  const std::string said = said_about(robot_in_processes("<proces name='a'/>", "process='a'", "", ""));
  CHECK(said ==
        "test.xml:1:17: error G003: there is no element <proces> in <graph>; it may contain: arg, "
        "profile, machine, process, hardware, component, group, connect, change, include, use; did you mean "
        "\"process\"?\n");
}

TEST_CASE("settings of processes do not hide what is wrong elsewhere", "[graph][process]") {
  const std::string said = said_about(robot_in_processes("<process name='a' priority='0'/>", "process='b'",
                                                         "process='a'", "start_after='nobody'"));
  CHECK(said.find("error G032: process \"a\": priority: \"0\" is out of range: 1 to 99") !=
        std::string::npos);
  CHECK(said.find("error G063: component \"base\": there is no process \"b\"") != std::string::npos);
  CHECK(said.find("error G016: component \"fuser\": start_after: there is no component \"nobody\"") !=
        std::string::npos);
}

TEST_CASE("a port that pushes to more connections by DDS than it can serve is refused before the start",
          "[graph][process][link]") {
  const auto said_of = [](int count) {
    std::string text =
        "<graph name='g'><process name='a'/><process name='b'/><hardware name='robot' type='orca.hw.Sim'/>"
        "<component name='base' type='orca.RobotBaseServer' hardware='robot' process='a'/>";
    for (int i = 0; i < count; ++i) {
      const std::string name = "avoid" + std::to_string(i);
      text += "<component name='" + name + "' type='orca.SonarAvoid' process='b'/>" +
              "<connect from='base.SonarRangeReadingsPush' to='" + name + ".sonar' link='dds'/>";
    }
    return said_about(text + "</graph>");
  };
  CHECK(said_of(62).find("G067") == std::string::npos);
  CHECK(said_of(63).find(
            "error G067: this is connection 63 of port \"base.SonarRangeReadingsPush\" by DDS, and a "
            "port serves 62") != std::string::npos);
}

TEST_CASE("the address of a machine is an IP address or a host name, and its interface may be one",
          "[graph][process]") {
  const auto said_of = [](const std::string& attribute) {
    return said_about(robot_in_processes(
        "<machine name='m' " + attribute + "/><process name='main' machine='m'/>", "", "", ""));
  };
  for (const std::string good : {"10.0.0.2", "fe80::1", "::1", "robot", "robot.lab.example.org", "r2-d2", ""})
    CHECK(said_of("address='" + good + "'").find("error") == std::string::npos);
  for (const std::string bad :
       {"not an address!", "10.0.0.256", "10.0.0", "robot..lab", "-robot", "robot.", "a b"})
    CHECK(said_of("address='" + bad + "'")
              .find("error G030: machine \"m\": address: \"" + bad +
                    "\" is neither an IP address nor a host name") != std::string::npos);
  CHECK(said_of("interface='wlan0'").find("error") == std::string::npos);
  CHECK(said_of("interface='wireless lan'").find("is no name of a network interface") != std::string::npos);
}

TEST_CASE("the JSON form has machines and processes with what is not as usual", "[graph][process]") {
  const std::string json = graph_json(must_load(robot_in_processes(
      "<machine name='m'/><process name='a' machine='m' executor='fiber' processors='1 2'/>"
      "<process name='main' machine='m'/>",
      "process='a'", "", "")));
  CHECK(json.find("\"machines\": [\n    {\n      \"name\": \"m\"\n    }\n  ]") != std::string::npos);
  CHECK(json.find("\"name\": \"a\",\n      \"machine\": \"m\",\n      \"executor\": \"fiber\",\n      "
                  "\"processors\": \"1 2\"\n") != std::string::npos);
  CHECK(json.find("\"link\": \"shm\"") != std::string::npos);
}
