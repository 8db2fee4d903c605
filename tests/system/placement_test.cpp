// SPDX-License-Identifier: GPL-3.0-or-later
// Processes, machines and links in the graph: virtual time takes no notice of them but for delays, and a start in real time refuses what
// Orca does not have yet.
#include <catch2/catch.hpp>

#include <regex>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

std::string hash_of(const std::string& graph, const Words& more) {
  const TempFolder folder;
  const Run run = run_deployer(Words{folder.write("graph.xml", graph)} + more + virtual_clock());
  INFO(run.err);
  REQUIRE(run.trace_hash());
  return *run.trace_hash();
}

std::string hash_of(const std::string& graph) { return hash_of(graph, {"--until", "20 s"}); }

// Gives a component of the text a process.
void put(const std::string& component, const std::string& process, std::string& graph) {
  const std::string tag = "<component name=\"" + component + "\"";
  const std::size_t at = graph.find(tag);
  REQUIRE(at != std::string::npos);
  graph.insert(at + tag.size(), " process=\"" + process + "\"");
}

void declare(const std::string& elements, std::string& graph) {
  const std::size_t at = graph.find("  <component");
  REQUIRE(at != std::string::npos);
  graph.insert(at, elements);
}

// Each component of scout_goto in a process of its own, as far as possible.
std::string scattered() {
  std::string graph = ShippedGraph("scout_goto").text();
  for (const char* name : {"command", "goto", "avoid", "fuser", "base"}) {
    put(name, std::string("in_") + name, graph);
    declare("<process name=\"in_" + std::string(name) + "\" executor=\"fiber\" priority=\"7\"/>", graph);
  }
  put("localizer", "in_base", graph);
  return graph;
}

// The base on one machine, the rest on another.
std::string on_two_machines() {
  std::string graph = ShippedGraph("scout_goto").text();
  declare(
      "<machine name=\"robot\"/><machine name=\"laptop\"/><process name=\"wheels\" machine=\"robot\"/>"
      "<process name=\"main\" machine=\"laptop\"/>",
      graph);
  put("base", "wheels", graph);
  put("localizer", "wheels", graph);
  return graph;
}

}  // namespace

TEST_CASE("in virtual time the trace hash is the same wherever the graph puts components",
          "[system][placement]") {
  const std::string usual = hash_of(ShippedGraph("scout_goto").text());
  CHECK(hash_of(scattered()) == usual);
  CHECK(hash_of(on_two_machines()) == usual);
}

TEST_CASE("in virtual time scout_goto_processes is the run of scout_goto to its end", "[system][placement]") {
  CHECK(hash_of(ShippedGraph("scout_goto_processes").text(), {}) ==
        hash_of(ShippedGraph("scout_goto").text(), {}));
}

TEST_CASE("in virtual time two_machines is the run of scout_goto to its end", "[system][placement]") {
  CHECK(hash_of(ShippedGraph("two_machines").text(), {}) == hash_of(ShippedGraph("scout_goto").text(), {}));
}

TEST_CASE("scout_goto_processes has shared memory between its processes and nowhere else",
          "[system][placement]") {
  const Run printed = run_deployer({source_file("graphs/scout_goto_processes.xml"), "--list-ports"});
  CHECK(printed.exit_code() == 0);
  CHECK(printed.out.find("to base.MotionCommandSend (shm)") != std::string::npos);
  CHECK(std::regex_search(printed.out, std::regex("avoid.motion .* to fuser.motion\n")));
}

TEST_CASE("what print writes of a graph with processes is the same graph, and the same run",
          "[system][placement]") {
  const TempFolder folder;
  const Run printed = run_deployer({folder.write("graph.xml", scattered()), "--print"});
  REQUIRE(printed.exit_code() == 0);
  CHECK(hash_of(printed.out) == hash_of(scattered()));
}

TEST_CASE("a graph that needs the network is checked and shown on any machine", "[system][placement]") {
  const TempFolder folder;
  const std::string graph = folder.write("graph.xml", on_two_machines());
  for (const char* action : {"--check", "--print", "--dot", "--mermaid", "--list-ports"}) {
    CAPTURE(action);
    CHECK(run_deployer({graph, action}).exit_code() == 0);
  }
  CHECK(run_deployer(Words{graph, "--check"} + virtual_clock()).exit_code() == 0);
}

TEST_CASE("two simulated robots of one world in two processes are refused, with the reason",
          "[system][placement]") {
  const TempFolder folder;
  const auto param = [](const std::string& name, const std::string& value) {
    return "<param name='" + name + "' value='" + value + "'/>";
  };
  const auto hardware = [&](const std::string& name, const std::string& process, const std::string& x) {
    return "<hardware name='" + name + "' type='orca.hw.Sim'>" +
           param("world", source_file("sim/worlds/court.xml")) +
           param("robot", source_file("sim/robots/nomad_scout.urdf")) + param("name", name) + param("x", x) +
           param("y", "4 m") + "</hardware><component name='base_" + name +
           "' type='orca.RobotBaseServer' hardware='" + name + "' process='" + process +
           "' autonomous='true'/>";
  };
  const auto check = [&](const std::string& process) {
    const std::string text = "<graph name='pair'><process name='p'/><process name='q'/>" +
                             hardware("one", "p", "2 m") + hardware("two", process, "5 m") + "</graph>";
    return run_deployer({folder.write("graph.xml", text), "--check"});
  };
  const Run apart = check("q");
  INFO(apart.err);
  CHECK(apart.exit_code() == 2);
  CHECK(
      apart.says("error G066: hardware \"two\": parameter \"world\": it is the world of hardware \"one\" "
                 "too, and a simulated "
                 "world lives in one process; \"two\" is in the process \"q\", \"one\" is in the process "
                 "\"p\"; put both "
                 "into one process"));
  CHECK(check("p").exit_code() == 0);
}

TEST_CASE("a delay between machines or processes is a part of a run, the same one each time",
          "[system][placement]") {
  const auto drive = [](const std::string& graph, const Words& more) {
    const Run run = run_deployer(
        Words{source_file("graphs/" + graph + ".xml"), "--until", "20 s"} + more + virtual_clock(),
        Seconds(60));
    INFO(run.err);
    REQUIRE(run.exit_code() == 0);
    REQUIRE(run.trace_hash());
    return *run.trace_hash();
  };
  const std::string none = drive("scout_goto", {});
  for (const std::string graph : {"two_machines", "scout_goto_processes"}) {
    CHECK(drive(graph, {}) == none);
    const std::string delayed = drive(graph, {"--set", "delay=100 ms"});
    CHECK(delayed != none);
    CHECK(drive(graph, {"--set", "delay=100 ms", "--executor", "baton"}) == delayed);
  }
}
