// SPDX-License-Identifier: GPL-3.0-or-later
#include "members/ledger.hpp"

#include <catch2/catch.hpp>

#include "orca/idl/object_type.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

// Keeps what it hears.
class Hearing final : public host::RunListener {
 public:
  void arrived(const idl::Arrived& arrived) override { names.push_back(arrived.name()); }
  void alarm(const idl::Alarm& alarm) override { alarms.push_back(kind_text(alarm)); }
  void robots(const host::RobotNames& robots) override { known = robots; }
  [[noreturn]] void abandon(const host::RunResult& /*result*/) override { std::abort(); }

  std::vector<std::string> names;
  std::vector<std::string> alarms;
  host::RobotNames known;
};

graph::Graph scout_in_two() {
  graph::Graph graph;
  for (const auto& [name, process] : {std::pair("goto", "behaviours"), {"base", "base"}}) {
    graph::ComponentNode node;
    node.name = name;
    node.process = process;
    graph.components.push_back(node);
  }
  graph.components[1].hardware = "scout";
  graph.hardware.emplace_back().name = "scout";
  return graph;
}

StateChange works(const std::string& component) {
  return {component, static_cast<std::uint64_t>(host::ComponentState::work), "", true, false, false};
}

template <class T>
std::vector<std::byte> bytes_of(const T& object) {
  std::vector<std::byte> bytes;
  object_type<T>().serialize(&object, bytes);
  return bytes;
}

}  // namespace

TEST_CASE("what the processes report on their components is known together", "[supervisor][ledger]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  REQUIRE(ledger.take(works("goto"), "behaviours").ok());
  CHECK(ledger.reports()("goto").state == host::ComponentState::work);
  CHECK(ledger.reports()("goto").has_worked);
  CHECK(ledger.reports()("base").state == host::ComponentState::init);
  CHECK(ledger.look().working == 1);
}

TEST_CASE("what is said of a component that the graph does not have, or of no state, is not believed",
          "[supervisor][ledger]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  CHECK(ledger.take(works("ghost"), "behaviours").error().code == Code::data_loss);
  StateChange change = works("goto");
  change.state = static_cast<std::uint64_t>(host::ComponentState::exit) + 1;
  CHECK(ledger.take(change, "behaviours").error().code == Code::data_loss);
  CHECK(ledger.take(ArrivedReport{{std::byte{1}}}, "behaviours").error().code == Code::data_loss);
  CHECK(hearing.names.empty());
}

TEST_CASE("arrivals and alarms of all processes reach the listener and the result", "[supervisor][ledger]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  idl::Arrived arrived;
  arrived.name() = "kitchen";
  REQUIRE(ledger.take(ArrivedReport{bytes_of(arrived)}, "behaviours").ok());
  ledger.raise(idl::PROCESS_ENDED, "", "process base was ended by SIGKILL");
  CHECK(hearing.names == std::vector<std::string>{"kitchen"});
  CHECK(hearing.alarms == std::vector<std::string>{"PROCESS_ENDED"});
  host::RunResult result;
  ledger.fill(result);
  REQUIRE(result.arrivals.size() == 1);
  CHECK(result.arrivals[0].name() == "kitchen");
  REQUIRE(result.alarms.size() == 1);
  CHECK(result.alarms[0].text() == "process base was ended by SIGKILL");
  CHECK(ledger.look().last_alarm == "PROCESS_ENDED: process base was ended by SIGKILL");
}

TEST_CASE("the components of a process that is lost are gone, and nothing waits for its rest",
          "[supervisor][ledger]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  REQUIRE(ledger.take(works("goto"), "behaviours").ok());
  REQUIRE(ledger.take(RestChange{false}, "behaviours").ok());
  CHECK_FALSE(ledger.at_rest());
  ledger.lose("behaviours", "its process was ended by SIGKILL");
  CHECK(ledger.at_rest());
  CHECK(ledger.reports()("goto").state == host::ComponentState::unloaded);
  CHECK(ledger.reports()("goto").failure == "its process was ended by SIGKILL");
}

TEST_CASE("robots are introduced by the hardware of all processes", "[supervisor][ledger]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  REQUIRE(ledger.take(Built{{{"scout", "Dewey"}}}, "base").ok());
  ledger.introduce();
  CHECK(hearing.known.robots == std::vector<std::string>{"Dewey"});
  CHECK(hearing.known.of("base") == "Dewey");
}

TEST_CASE("alarms of a process stay when it is lost, until they are acknowledged", "[supervisor][ledger]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  const idl::Alarm failed = host::make_alarm(idl::FAILED, "goto", "work()", "it threw 7");
  REQUIRE(ledger.take(AlarmReport{bytes_of(failed)}, "behaviours").ok());
  ledger.lose("behaviours", "it was ended");
  ledger.raise(idl::PROCESS_ENDED, "behaviours", "process behaviours was ended");
  REQUIRE(ledger.alarms().size() == 2);
  CHECK(ledger.alarms()[0].alarm.source() == "goto");
  CHECK(ledger.alarms()[1].process == "behaviours");
  REQUIRE(ledger.acknowledge(ledger.alarms()[0].number).ok());
  REQUIRE(ledger.alarms().size() == 1);
  CHECK(ledger.alarms()[0].alarm.kind() == idl::PROCESS_ENDED);
}

TEST_CASE("an alarm from before this supervisor is kept once, and told to nobody", "[supervisor][ledger]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  idl::Alarm alarm;
  alarm.kind(idl::FAILED);
  alarm.source("goto");
  alarm.active(true);
  Standing standing;
  standing.alarms.emplace_back("behaviours", bytes_of(alarm));
  REQUIRE(ledger.take(standing, "base").ok());
  REQUIRE(ledger.take(standing, "behaviours").ok());
  CHECK(hearing.alarms.empty());
  REQUIRE(ledger.alarms().size() == 1);
  CHECK(ledger.alarms()[0].process == "behaviours");
  CHECK(ledger.alarms()[0].times == 1);
  standing.alarms.emplace_back("base", std::vector<std::byte>{std::byte{1}});
  CHECK_FALSE(ledger.take(standing, "base").ok());
}

TEST_CASE("an alarm whose reason is gone is not active any more, and stays until it is acknowledged",
          "[supervisor][ledger][alarms]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  ledger.settle(idl::MACHINE_LOST, "brain", "machine brain is heard");
  CHECK(ledger.alarms().empty());
  ledger.raise(idl::MACHINE_LOST, "", "machine brain was not heard", "brain");
  ledger.raise(idl::MACHINE_LOST, "", "machine eye was not heard", "eye");
  REQUIRE(ledger.alarms().size() == 2);
  ledger.settle(idl::MACHINE_LOST, "brain", "machine brain is heard again");
  REQUIRE(ledger.alarms().size() == 2);
  CHECK_FALSE(ledger.alarms()[0].alarm.active());
  CHECK(ledger.alarms()[0].alarm.text() == "machine brain is heard again");
  CHECK(ledger.alarms()[1].alarm.active());
  CHECK(ledger.acknowledge(ledger.alarms()[0].number).ok());
  CHECK(ledger.alarms().size() == 1);
}

TEST_CASE("an emergency stop cannot be acknowledged before it is released", "[supervisor][ledger][alarms]") {
  const graph::Graph graph = scout_in_two();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  ledger.raise(idl::ESTOP, "", "all motors are held");
  REQUIRE(ledger.alarms().size() == 1);
  const std::uint64_t number = ledger.alarms()[0].number;
  CHECK(ledger.acknowledge(number).error().code == Code::failed_precondition);
  ledger.settle(idl::ESTOP, "", "released");
  CHECK(ledger.acknowledge(number).ok());
  CHECK(ledger.alarms().empty());
}

TEST_CASE("what a process on demand carried counts for all of its lives, and is not missed if it had none",
          "[supervisor][ledger][on_demand]") {
  graph::Graph graph = scout_in_two();
  graph.processes = {{.name = "base", .on_demand = true}, {.name = "behaviours"}};
  graph.hardware.clear();
  Hearing hearing;
  Ledger ledger(graph, hearing, TimePoint{});
  Tally tally;
  tally.servers = {{"base.in", {3}}};
  CHECK_FALSE(ledger.counters());
  REQUIRE(ledger.take(Tally{}, "behaviours").ok());
  CHECK(ledger.counters());
  for (int life = 0; life < 2; ++life) {
    REQUIRE(ledger.take(tally, "base").ok());
    ledger.lose("base", "nobody needed it");
  }
  REQUIRE(ledger.counters());
  CHECK(ledger.counters()->servers.at("base.in").accepted == 6);
}
