// SPDX-License-Identifier: GPL-3.0-or-later
// Which of several servers a port uses, and when it takes another one.
#include "orca/host/edge_choice.hpp"

#include <catch2/catch.hpp>

#include <set>

#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

namespace {

graph::Edge choice(const std::string& server, std::uint32_t number, const std::string& client = "goto") {
  graph::Edge edge;
  edge.from = {server, "pose"};
  edge.to = {client, "localizer"};
  edge.choice = number;
  return edge;
}

// A system of which some components are down.
struct SystemWithLosses {
  graph::Graph graph;
  std::set<std::string> down{};
  std::set<std::string> coming_up{};
  EdgeChoice edges{graph};

  // Returns the servers that ports move to.
  std::vector<std::string> look() {
    std::vector<std::string> moved;
    for (const EdgeChoice::Move& move : edges.look([&](const std::string& name) {
           if (coming_up.contains(name)) return Standing{false};
           return down.contains(name) ? Standing{false, "is down: it was killed"} : Standing{};
         })) {
      moved.push_back(move.edge->server().component);
      last_text = move.text;
    }
    return moved;
  }

  std::string last_text{};
};

graph::Graph three_localizers() {
  graph::Graph graph;
  // Written in another order than that of the choice.
  graph.edges = {choice("worst", 3), choice("best", 1), choice("good", 2)};
  return graph;
}

ComponentReport report_in(ComponentState state, const std::string& failure = "") {
  ComponentReport report;
  report.state = state;
  report.failure = failure;
  return report;
}

using Providers = std::vector<std::string>;

const std::string kLives =
    R"(<component name="bad" type="test.Life" may_fail="true"><param name="mode" value="work fails"/></component>)"
    R"(<component name="good" type="test.Life"/>)"
    R"(<component name="user" type="test.User"><param name="from" value="1"/><param name="until" value="3"/></component>)";

RecordedRun run_with(const std::string& connection) {
  RunOptions options = virtual_run();
  options.until = 5s;
  return record_run("", kLives + connection, options);
}

std::uint64_t delivered(const RecordedRun& run, const std::string& from) {
  for (const auto& edge : run.result.counters.edges)
    if (edge.from == from) return edge.counters.delivered;
  return 0;
}

}  // namespace

TEST_CASE("a port uses its first choice as long as that is up", "[host][trading]") {
  SystemWithLosses system{three_localizers()};
  REQUIRE(system.edges.in_use().size() == 1);
  CHECK(system.edges.in_use().front()->server().component == "best");
  system.down = {"good", "worst"};
  CHECK(system.look().empty());
}

TEST_CASE("a port whose server is down moves to the next choice that is up", "[host][trading]") {
  SystemWithLosses system{three_localizers()};
  system.down = {"best"};
  CHECK(system.look() == Providers{"good"});
  CHECK(system.last_text == "localizer uses good.pose from now on, because best is down: it was killed");
  CHECK(system.look().empty());
  system.down = {"best", "good"};
  CHECK(system.look() == Providers{"worst"});
}

TEST_CASE("a port does not move back to a better choice", "[host][trading]") {
  SystemWithLosses system{three_localizers()};
  system.down = {"best"};
  CHECK(system.look() == Providers{"good"});
  system.down = {};
  CHECK(system.look().empty());
  system.down = {"good"};
  CHECK(system.look() == Providers{"best"});
}

TEST_CASE("a port stays where it is while none of its choices is up", "[host][trading]") {
  SystemWithLosses system{three_localizers()};
  system.down = {"best", "good", "worst"};
  CHECK(system.look().empty());
  CHECK(system.edges.in_use().front()->server().component == "best");
  system.down = {"best", "good"};
  CHECK(system.look() == Providers{"worst"});
}

TEST_CASE("each port moves for itself, and one without a choice does not", "[host][trading]") {
  graph::Graph graph = three_localizers();
  graph.edges.push_back(choice("good", 1, "avoid"));
  graph.edges.push_back(choice("best", 2, "avoid"));
  graph.edges.push_back(choice("best", 0, "fuser"));
  SystemWithLosses system{graph};
  system.down = {"best"};
  CHECK(system.look() == Providers{"good"});
  CHECK(system.edges.in_use().size() == 2);
}

TEST_CASE("a port waits for a server that is coming up, and takes none that is", "[host][trading]") {
  SystemWithLosses system{three_localizers()};
  system.coming_up = {"best", "good"};
  CHECK(system.look().empty());
  system.coming_up = {"good"};
  system.down = {"best"};
  CHECK(system.look() == Providers{"worst"});
}

TEST_CASE("a component is down if it has failed, ended badly, or is lost with its process",
          "[host][trading]") {
  const std::string killed = "its process was killed";
  for (const auto state :
       {ComponentState::idle, ComponentState::connect, ComponentState::work, ComponentState::work_done,
        ComponentState::suspended_work, ComponentState::unloaded})
    CHECK(standing_of(report_in(state)).is_up);
  CHECK(standing_of(report_in(ComponentState::unloaded, killed)).why_down ==
        "is down: its process was killed");
  CHECK(standing_of(report_in(ComponentState::broken, "work() threw 7")).why_down ==
        "is down: work() threw 7");
  ComponentReport retired = report_in(ComponentState::idle, "work() failed");
  retired.ended_badly = true;
  CHECK(standing_of(retired).why_down == "is down: work() failed");
  CHECK_FALSE(standing_of(retired).is_up);
}

TEST_CASE("a component that is coming up is neither up nor down", "[host][trading]") {
  CHECK_FALSE(standing_of(report_in(ComponentState::init)).is_up);
  CHECK(standing_of(report_in(ComponentState::init)).why_down.empty());
}

TEST_CASE("in one process a port leaves a component that has failed, and the trace is the same each time",
          "[host][trading]") {
  const std::string seek = R"(<connect to="user.push" seek="type == 'test.Life'"/>)";
  const RecordedRun run = run_with(seek);
  CHECK(run.warnings ==
        Providers{"user: push uses good.out from now on, because bad is down: work() failed: no work today"});
  CHECK(delivered(run, "good.out") > 10);
  CHECK(run.result.trace_hash.has_value());
  CHECK(run_with(seek).result.trace_hash == run.result.trace_hash);
}

TEST_CASE("with a fixed connection to the component that fails nothing arrives", "[host][trading]") {
  const RecordedRun run = run_with(R"(<connect from="bad.out" to="user.push"/>)");
  CHECK(delivered(run, "bad.out") == 0);
}

TEST_CASE("a candidate that was never needed is not said to be idle", "[host][trading]") {
  const RecordedRun run = run_with(R"(<connect to="user.push" seek="name == 'good' "/>)");
  for (const std::string& warning : run.warnings)
    CHECK(warning.find("good: has never worked") == std::string::npos);
  const RecordedRun spare = run_with(R"(<connect from="good.out" to="user.push" choice="1"/>)"
                                     R"(<connect from="bad.out" to="user.push" choice="2"/>)");
  CHECK(delivered(spare, "good.out") > 10);
  CHECK(spare.warnings.empty());
}
