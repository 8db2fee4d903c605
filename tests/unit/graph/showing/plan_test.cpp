// SPDX-License-Identifier: GPL-3.0-or-later
// The way from a running system to another graph: what changes while it runs, and what does not.
#include "orca/graph/plan.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

using namespace orca;
using Catch::Contains;
using graph::Effort;
using graph::GraphPlan;
using graph::obstacles_of;
using graph::plan_of;
using graph::PlanMeans;

namespace {

using Contracts = std::map<std::string, Contract>;

graph::Graph running_robot() {
  graph::Graph graph;
  graph.name = "robot";
  graph::ComponentNode avoid;
  avoid.name = "avoid";
  avoid.type = "orca.SonarAvoid";
  avoid.params = {{"margin", 0.1}, {"size", 0.3}};
  graph::ComponentNode base;
  base.name = "base";
  base.type = "orca.RobotBaseServer";
  base.hardware = "scout";
  base.params = {{"rate", 10.0}, {"device", std::string("a")}};
  graph::ComponentNode spare;
  spare.name = "spare";
  spare.type = "orca.LogServer";
  graph.components = {avoid, base, spare};
  graph.hardware = {{"scout", "orca.hw.Sim", graph::kMainProcess, {{"seed", 1.0}}, {}}};
  graph::Edge sonar;
  sonar.from = {"base", "SonarPush"};
  sonar.to = {"avoid", "sonar"};
  graph.edges = {sonar};
  return graph;
}

Contracts contracts() {
  const auto param = [](const std::string& name, bool fixed) {
    ParamContract one;
    one.name = name;
    one.fixed = fixed;
    return one;
  };
  Contracts all;
  all["avoid"].params = {param("margin", false), param("size", true)};
  all["base"].params = {param("rate", false), param("device", true)};
  return all;
}

// Returns the way to a graph that was changed so.
template <class Change>
GraphPlan plan_after(const Change& change, bool may_renew = true) {
  graph::Graph wanted = running_robot();
  change(wanted);
  return plan_of(running_robot(), wanted, contracts(), PlanMeans{may_renew, {}});
}

// The same where all runs in one process, which cannot be started again.
template <class Change>
GraphPlan plan_in_one_process(const Change& change) {
  return plan_after(change, false);
}

// A robot whose base has a process of its own, and whose spare component another one.
graph::Graph robot_of_three() {
  graph::Graph graph = running_robot();
  graph.components[1].process = graph.hardware[0].process = "base";
  graph.components[2].process = "third";
  graph.edges[0].link = graph::Link::shm;
  for (const std::string name : {"base", "third"}) graph.processes.push_back({.name = name});
  return graph;
}

template <class Change>
GraphPlan plan_for_three(const Change& change) {
  graph::Graph wanted = robot_of_three();
  change(wanted);
  return plan_of(robot_of_three(), wanted, contracts(), PlanMeans{true, {}});
}

using ProcessNames = std::set<std::string>;

bool is_for_a_new_start(const GraphPlan& plan) {
  const bool has_steps = !plan.exchanges.empty() || !plan.settings.empty();
  return !plan.is_possible() && !has_steps && plan.lines.size() == 1;
}

graph::Edge connection(const std::string& from, const std::string& to, int number = 0) {
  graph::Edge edge;
  edge.from = {from, "out" + std::to_string(number)};
  edge.to = {to, "in"};
  return edge;
}

graph::ComponentNode newcomer(const std::string& name) {
  graph::ComponentNode node;
  node.name = name;
  node.type = "orca.Goto";
  return node;
}

// Changes a graph in one way of several. Returns whether that is possible without a new start.
bool change_somehow(graph::Graph& graph, std::mt19937& random) {
  const auto number = [&](int most) { return std::uniform_int_distribution<>(0, most)(random); };
  const auto is_there = [&](const std::string& name) { return graph.find_component(name) != nullptr; };
  switch (number(10)) {
    case 0: graph.components[0].params["margin"] = 0.1 * number(5); return true;
    case 1: graph.components[0].params["size"] = 0.1 * (4 + number(5)); return true;
    case 2: graph.components[0].type = "orca.Other" + std::to_string(number(2)); return true;
    case 3: graph.components[1].params["rate"] = 20.0 + number(5); return true;
    case 4: graph.groups = {{"group" + std::to_string(number(3)), {"avoid"}, {}}}; return true;
    case 5: graph.supervision.restarts = 4 + number(9); return false;
    case 6: graph.edges[0].queue.depth = 2 + static_cast<std::uint32_t>(number(5)); return true;
    case 7: graph.edges = {connection("avoid", "base"), connection("base", "avoid", number(1))}; return true;
    case 8:
      if (!is_there("more")) graph.components.push_back(newcomer("more"));
      graph.edges.push_back(connection("more", "base", number(3)));
      return true;
    case 9:
      std::erase_if(graph.components, [](const auto& node) { return node.name == "spare"; });
      return true;
    default: graph.machines.push_back({.name = "m" + std::to_string(graph.machines.size())}); return false;
  }
}

std::map<std::string, graph::Edge> edges_by_name(const graph::Graph& graph) {
  std::map<std::string, graph::Edge> edges;
  for (const graph::Edge& edge : graph.edges) edges[edge.name()] = edge;
  return edges;
}

}  // namespace

TEST_CASE("of two hundred pairs of graphs each plan is carried out whole, or refused", "[graph][apply]") {
  std::mt19937 random(16);  // NOLINT(cert-msc51-cpp): the same pairs each time
  int refused = 0;
  for (int pair = 0; pair < 200; ++pair) {
    graph::Graph running = running_robot();
    graph::Graph wanted = running_robot();
    bool is_possible = true;
    for (int i = 0; i < 3; ++i) is_possible = change_somehow(wanted, random) && is_possible;
    const GraphPlan plan = plan_of(running, wanted, contracts(), PlanMeans{true, {}});
    CAPTURE(pair, graph::diff_text(graph::diff(running, wanted)));
    CHECK(plan.is_possible() == is_possible);
    refused += is_possible ? 0 : 1;
    if (!is_possible) continue;
    go_over(running, wanted);
    CHECK(graph::diff(running, wanted).empty());
    for (const graph::ComponentNode& node : plan.added) CHECK(node == *wanted.find_component(node.name));
    for (const std::string& name : plan.removed) CHECK(wanted.find_component(name) == nullptr);
    CHECK(plan.connections_of(true).size() + plan.connections_of(false).size() == plan.connections.size());
    graph::Graph rewired = running_robot();
    for (const GraphPlan::Rewiring& one : plan.connections)
      put(one.after.value_or(*one.before), one.after.has_value(), rewired.edges);
    CHECK(edges_by_name(rewired) == edges_by_name(wanted));
    for (const GraphPlan::Rewiring& one : graph::reversed(plan.connections))
      put(one.after.value_or(one.before.value_or(graph::Edge{})), one.after.has_value(), rewired.edges);
    CHECK(edges_by_name(rewired) == edges_by_name(running_robot()));
    for (const auto& [component, params] : plan.settings)
      for (const auto& [name, value] : params)
        CHECK(wanted.find_component(component)->params.at(name) == value);
  }
  CHECK(refused > 20);
  CHECK(refused < 180);
}

TEST_CASE("between equal graphs there is nothing to do", "[graph][apply]") {
  const GraphPlan plan = plan_of(running_robot(), running_robot(), contracts(), PlanMeans{true, {}});
  CHECK(plan.lines.empty());
  CHECK(plan.is_possible());
  CHECK(plan.exchanges.empty());
  CHECK(plan.settings.empty());
}

TEST_CASE("a parameter that may change is set, alone", "[graph][apply]") {
  const GraphPlan plan = plan_after([](graph::Graph& g) { g.components[0].params["margin"] = 0.2; });
  CHECK(plan.is_possible());
  CHECK(plan.exchanges.empty());
  CHECK(plan.settings == std::map<std::string, graph::Params>{{"avoid", {{"margin", 0.2}}}});
  REQUIRE(plan.lines.size() == 1);
  CHECK(plan.lines[0].part == "~ component avoid");
  CHECK(plan.lines[0].change == graph::FieldChange{"param margin", "0.1", "0.2"});
  CHECK_THAT(to_string(plan.lines[0].effort), Contains("between two laps"));
}

TEST_CASE("a fixed parameter, or another type, means new code with all parameters", "[graph][apply]") {
  const bool changes_type = GENERATE(false, true);
  const GraphPlan plan = plan_after([&](graph::Graph& g) {
    g.components[0].params["margin"] = 0.2;
    if (changes_type) {
      g.components[0].type = "orca.LaserAvoid";
    } else {
      g.components[0].params["size"] = 0.4;
    }
  });
  CHECK(plan.is_possible());
  CHECK(plan.settings.empty());
  REQUIRE(plan.exchanges.size() == 1);
  CHECK(plan.exchanges[0].component == "avoid");
  CHECK(plan.exchanges[0].type == (changes_type ? "orca.LaserAvoid" : "orca.SonarAvoid"));
  CHECK(plan.exchanges[0].params == graph::Params{{"margin", 0.2}, {"size", changes_type ? 0.3 : 0.4}});
  CHECK(std::ranges::all_of(plan.lines, [](const auto& line) { return line.effort == Effort::exchange; }));
}

TEST_CASE("a component that is bound to hardware keeps its code, but takes parameters", "[graph][apply]") {
  CHECK(is_for_a_new_start(
      plan_in_one_process([](graph::Graph& g) { g.components[1].params["device"] = std::string("b"); })));
  CHECK(is_for_a_new_start(
      plan_in_one_process([](graph::Graph& g) { g.components[1].type = "orca.LaserServer"; })));
  CHECK(plan_after([](graph::Graph& g) { g.components[1].params["rate"] = 20.0; }).is_possible());
}

TEST_CASE("whatever else differs needs a new start where there is one process for all", "[graph][apply]") {
  CHECK(is_for_a_new_start(plan_in_one_process([](graph::Graph& g) { g.components[0].priority = 5; })));
  CHECK(is_for_a_new_start(plan_in_one_process([](graph::Graph& g) { g.hardware[0].params["seed"] = 2.0; })));
  CHECK(plan_in_one_process([](graph::Graph& g) { g.processes.push_back({.name = "empty"}); }).is_possible());
}

TEST_CASE("what cannot change in a process that runs is there when the process begins anew",
          "[graph][apply]") {
  const auto renews = [](const auto& change, const ProcessNames& processes) {
    const GraphPlan plan = plan_for_three(change);
    return plan.is_possible() && plan.renewed == processes && plan.exchanges.empty() &&
           plan.settings.empty() &&
           std::ranges::all_of(plan.lines, [](const auto& line) { return line.effort == Effort::renew; });
  };
  using graph::Graph;
  CHECK(renews([](Graph& g) { g.hardware[0].params["seed"] = 2.0; }, {"base"}));
  CHECK(renews([](Graph& g) { g.components[0].priority = 5; }, {"main"}));
  CHECK(renews([](Graph& g) { g.components[1].type = "orca.LaserServer"; }, {"base"}));
  CHECK(renews([](Graph& g) { g.components[1].params["device"] = std::string("b"); }, {"base"}));
  CHECK(renews([](Graph& g) { g.processes[0].spin = 1ms; }, {"base"}));
  CHECK(renews([](Graph& g) { g.components[2].process = "main"; }, {"main", "third"}));
  CHECK(renews([](Graph& g) { g.components.pop_back(); }, {"third"}));
  CHECK(renews(
      [](Graph& g) {
        g.components.push_back(newcomer("more"));
        g.components.back().process = "fourth";
        g.processes.push_back({.name = "fourth"});
      },
      {"fourth"}));
}

TEST_CASE("a process that was alone begins anew if there is another one, since both need memory in common",
          "[graph][apply]") {
  const GraphPlan plan = plan_after([](graph::Graph& g) {
    g.components.push_back(newcomer("more"));
    g.components.back().process = "other";
    g.processes.push_back({.name = "other"});
  });
  CHECK(plan.is_possible());
  CHECK(plan.renewed == ProcessNames{"main", "other"});
}

TEST_CASE("processes that stay change their ends of connections to one that begins anew", "[graph][apply]") {
  const GraphPlan changed = plan_for_three([](graph::Graph& g) {
    g.hardware[0].params["seed"] = 2.0;
    g.edges[0].queue.depth = 9;
    g.components[0].params["margin"] = 0.2;
  });
  CHECK(changed.renewed == ProcessNames{"base"});
  REQUIRE(changed.connections.size() == 1);
  CHECK(changed.connections[0].after->queue.depth == 9);
  CHECK(changed.settings.contains("avoid"));

  const auto moves_base = [](graph::Graph& g) { g.components[1].process = g.hardware[0].process = "third"; };
  const GraphPlan moved = plan_for_three(moves_base);
  CHECK(moved.renewed == ProcessNames{"base", "third"});
  CHECK(moved.connections.empty());
  const GraphPlan only_again = plan_for_three([](graph::Graph& g) { g.processes[0].spin = 1ms; });
  CHECK(only_again.connections.empty());
}

TEST_CASE("processes that wake a component elsewhere than before begin anew with it", "[graph][apply]") {
  const auto becomes_fibers = [](graph::Graph& g) { g.processes[0].executor = Backend::fiber; };
  CHECK(plan_for_three(becomes_fibers).renewed == ProcessNames{"base", "main"});
  const auto moves_base = [](graph::Graph& g) { g.components[1].process = g.hardware[0].process = "third"; };
  graph::Graph wanted = robot_of_three();
  moves_base(wanted);
  CHECK(plan_of(robot_of_three(), wanted, contracts(), {true, Backend::fiber}).renewed ==
        ProcessNames{"base", "main", "third"});
  CHECK(plan_of(robot_of_three(), wanted, contracts(), {true, {}}).renewed == ProcessNames{"base", "third"});
}

TEST_CASE("both processes of a connection over DDS begin anew with it", "[graph][apply]") {
  const GraphPlan plan = plan_for_three([](graph::Graph& g) { g.edges[0].link = graph::Link::dds; });
  CHECK(plan.is_possible());
  CHECK(plan.renewed == ProcessNames{"base", "main"});
  CHECK(plan.connections.empty());
}

TEST_CASE("a process on demand does not begin anew, nor does one whose ports choose from others",
          "[graph][apply]") {
  CHECK_FALSE(plan_for_three([](graph::Graph& g) { g.processes[1].on_demand = true; }).is_possible());
  const GraphPlan plan = plan_for_three([](graph::Graph& g) {
    g.edges.push_back(connection("spare", "avoid"));
    g.edges.back().late_bound = true;
  });
  CHECK_FALSE(plan.is_possible());
  CHECK_THAT(obstacles_of(plan), Contains("ports that choose between several servers"));
}

TEST_CASE("components come and go beside the others, in the order in which they start", "[graph][apply]") {
  const GraphPlan plan = plan_after([](graph::Graph& g) {
    g.components.back() = newcomer("second");
    g.components.back().start_after = {"first"};
    g.components.push_back(newcomer("first"));
    g.edges.push_back(connection("second", "first"));
    g.edges.push_back(connection("first", "avoid"));
    g.edges.back().pattern = Pattern::push;
  });
  CHECK(plan.is_possible());
  REQUIRE(plan.added.size() == 2);
  CHECK(plan.added[0].name == "first");
  CHECK(plan.added[1].name == "second");
  CHECK(plan.removed == std::vector<std::string>{"spare"});
  REQUIRE(plan.lines.size() == 5);
  CHECK(plan.lines[0].part == "+ component first");
  CHECK(plan.lines[0].effort == Effort::add);
  CHECK(plan.lines[2].part == "- component spare");
  CHECK(plan.lines[2].effort == Effort::remove);
  REQUIRE(plan.connections_of(true).size() == 1);
  CHECK(plan.connections_of(true)[0].after->name() == "second.out0 to first.in");
  REQUIRE(plan.connections_of(false).size() == 1);
  CHECK(plan.connections_of(false)[0].after->name() == "first.out0 to avoid.in");
}

TEST_CASE("components that need another process, or are there on demand, need a new start",
          "[graph][apply]") {
  const auto with = [](const auto& change) {
    return [change](graph::Graph& g) {
      g.components.push_back(newcomer("more"));
      change(g.components.back());
    };
  };
  CHECK(is_for_a_new_start(
      plan_in_one_process(with([](graph::ComponentNode& node) { node.on_demand = true; }))));
  CHECK(
      is_for_a_new_start(plan_in_one_process(with([](graph::ComponentNode& node) { node.process = "x"; }))));
  CHECK(is_for_a_new_start(plan_in_one_process(with([](graph::ComponentNode& node) {
    node.ports["pose"].candidates = {{"a", "b"}};
  }))));
  const GraphPlan plan = plan_after([](graph::Graph& g) { g.components.pop_back(); });
  CHECK(plan.is_possible());
  CHECK(plan.removed == std::vector<std::string>{"spare"});
}

TEST_CASE("a connection is made, removed, or gets another policy", "[graph][apply]") {
  const GraphPlan removed = plan_after([](graph::Graph& g) { g.edges.clear(); });
  CHECK(removed.is_possible());
  REQUIRE(removed.connections.size() == 1);
  CHECK(removed.connections[0].before == running_robot().edges[0]);
  CHECK_FALSE(removed.connections[0].after);
  REQUIRE(removed.lines.size() == 1);
  CHECK(removed.lines[0].part == "- connection base.SonarPush to avoid.sonar");
  CHECK(removed.lines[0].effort == Effort::rewire);

  const GraphPlan changed = plan_after([](graph::Graph& g) { g.edges[0].queue.depth = 17; });
  REQUIRE(changed.connections.size() == 1);
  CHECK(changed.connections[0].before->queue.depth == 1);
  CHECK(changed.connections[0].after->queue.depth == 17);

  const GraphPlan made = plan_after([](graph::Graph& g) { g.edges.push_back(connection("avoid", "base")); });
  CHECK(made.is_possible());
  REQUIRE(made.connections.size() == 1);
  CHECK_FALSE(made.connections[0].before);
}

TEST_CASE("connections that cannot change while the system runs need a new start", "[graph][apply]") {
  const auto is_refused = [](const auto& change) {
    const GraphPlan plan = plan_in_one_process(change);
    return !plan.is_possible() && plan.connections.empty();
  };
  CHECK(is_refused([](graph::Graph& g) { g.edges[0].link = graph::Link::dds; }));
  CHECK(is_refused([](graph::Graph& g) { g.edges[0].choice = 1; }));
  CHECK(is_refused([](graph::Graph& g) {
    g.edges.clear();
    g.components[0].process = "other";
  }));
}

TEST_CASE("what needs a new start is named, and not more of it than can be read", "[graph][apply]") {
  const GraphPlan one = plan_in_one_process([](graph::Graph& g) { g.components[0].priority = 5; });
  CHECK(obstacles_of(one) == "the system has to be started again for ~ component avoid: priority");
  const GraphPlan many = plan_in_one_process([](graph::Graph& g) {
    for (const std::string name : {"a", "b", "c", "d", "e", "f"}) g.machines.push_back({.name = name});
  });
  CHECK_THAT(obstacles_of(many),
             Contains("+ machine d") && Contains("and 2 more changes") && !Contains("+ machine e"));
}

TEST_CASE("a possible change beside an impossible one does not make the plan possible", "[graph][apply]") {
  const GraphPlan plan = plan_in_one_process([](graph::Graph& g) {
    g.components[0].priority = 5;
    g.components[0].params["margin"] = 0.2;
  });
  CHECK_FALSE(plan.is_possible());
  CHECK(plan.lines.size() == 2);
}

TEST_CASE("another order of the start counts from the next start on", "[graph][apply]") {
  const GraphPlan plan = plan_after([](graph::Graph& g) { g.components[0].start_after = {"base"}; });
  CHECK(plan.is_possible());
  REQUIRE(plan.lines.size() == 1);
  CHECK(plan.lines[0].effort == Effort::none);
  graph::Graph running = running_robot();
  graph::Graph wanted = running_robot();
  wanted.components[0].start_after = {"base"};
  go_over(running, wanted);
  CHECK(graph::diff(running, wanted).empty());
}

TEST_CASE("another group costs nothing", "[graph][apply]") {
  const GraphPlan plan = plan_after([](graph::Graph& g) { g.groups.push_back({"all", {"avoid"}, {}}); });
  CHECK(plan.is_possible());
  REQUIRE(plan.lines.size() == 1);
  CHECK(plan.lines[0].effort == Effort::none);
}

TEST_CASE("a graph that went over to another one that is possible equals it", "[graph][apply]") {
  graph::Graph running = running_robot();
  graph::Graph wanted = running_robot();
  wanted.components[0].type = "orca.LaserAvoid";
  wanted.components[0].params = {{"cone", 1.5}};
  wanted.components[1].params["rate"] = 20.0;
  wanted.groups.push_back({"all", {"avoid"}, {}});
  wanted.edges.push_back(connection("avoid", "base"));
  REQUIRE(plan_of(running, wanted, contracts(), PlanMeans{true, {}}).is_possible());
  go_over(running, wanted);
  CHECK(graph::diff(running, wanted).empty());
}
