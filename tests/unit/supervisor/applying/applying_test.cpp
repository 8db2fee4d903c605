// SPDX-License-Identifier: GPL-3.0-or-later
// A graph that is carried out in a system whose processes the test plays, and what becomes of it if one of them ends.
#include "applying/applying.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <thread>

#include "orca/graph/placement.hpp"
#include "staged_process.hpp"

using namespace orca;
using namespace orca::supervisor;
using Catch::Contains;
using orca::test::StagedProcess;
using Words = std::vector<std::string>;

namespace {

class DeafListener final : public host::RunListener {
 public:
  [[noreturn]] void abandon(const host::RunResult& /*result*/) override { std::abort(); }
};

graph::ComponentNode part(const std::string& name, const std::string& process) {
  graph::ComponentNode node;
  node.name = name;
  node.type = "test.Part";
  node.process = process;
  node.params = {{"speed", 0.5}};
  return node;
}

graph::Graph graph_of_parts(const std::vector<graph::ComponentNode>& components) {
  graph::Graph graph;
  graph.name = "two";
  graph.components = components;
  for (const char* const name : {"a", "b"}) graph.processes.push_back({.name = name});
  return graph;
}

SystemFacts facts_of_parts(const graph::Graph& graph) {
  ParamContract speed;
  speed.name = "speed";
  speed.default_value = 0.1;
  SystemFacts facts;
  for (const graph::ComponentNode& node : graph.components) facts.contracts[node.name].params = {speed};
  return facts;
}

// What a process hears, in a few words.
std::string heard_as(const Order& order) {
  if (const auto* set = std::get_if<SetParams>(&order))
    return "set " + set->component + " " + set->values.at(0).second;
  if (const auto* add = std::get_if<AddComponent>(&order)) return "add " + add->node.name;
  if (const auto* remove = std::get_if<RemoveComponent>(&order)) return "remove " + remove->component;
  if (const auto* configure = std::get_if<Configure>(&order)) return "configure " + configure->component;
  if (const auto* gate = std::get_if<OpenGate>(&order)) return "open " + gate->component;
  return "";
}

// A system of two processes, a and b, with a component each.
class StagedSystem {
 public:
  StagedSystem() {
    for (StagedProcess* const process : processes_) {
      process->start(Member::Phase::up);
      process->member().note_built();
    }
  }

  // Carries a graph out. Each order is answered at once, but at the given one its process ends.
  // @return how that ends.
  std::string apply(graph::Graph wanted, std::size_t lost_at = 1000) {
    wanted_ = std::move(wanted);
    lost_at_ = lost_at;
    conductor_.run([&] {
      conductor_.begin("apply", [this] { applying_.apply({"wanted.xml"}, reply_); });
      while (applying_.can_change().ok() == false) {
        while (answer_next()) conductor_.go_on(Moment::clock::now());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the graph is read on another thread
        conductor_.go_on(Moment::clock::now());
      }
    });
    reply_.reset();
    auto answer = std::move(decode_answer(std::move(here_.wait_for_message(2s)).value())).value();
    while (!std::holds_alternative<EndAnswer>(answer))
      answer = std::move(decode_answer(std::move(here_.wait_for_message(2s)).value())).value();
    const Status outcome = std::get<EndAnswer>(answer).outcome;
    return outcome.ok() ? "" : outcome.error().text();
  }

  Words heard;
  bool is_accepted = false;

 private:
  std::size_t lost_at_ = 0;
  // Answers an order, if there is one.
  bool answer_next() {
    for (StagedProcess* const process : processes_) {
      if (process->member().process() == nullptr) continue;
      const std::optional<Order> order = process->hear();
      if (!order) continue;
      const std::string words = heard_as(*order);
      if (words.empty() || !process->is_asked()) return true;
      heard.push_back(process->member().name() + ": " + words);
      if (heard.size() == lost_at_ + 1) {
        applying_.lose(process->member().name());
        process->end();
      } else {
        process->answer();
      }
      return true;
    }
    return false;
  }

  DeafListener listener_;
  graph::Graph graph_ = graph_of_parts({part("left", "a"), part("right", "b")});
  graph::Graph wanted_;
  SystemFacts facts_ = facts_of_parts(graph_);
  const SupervisedOptions options_{};
  const RunIdentity run_ = std::move(begin_run(graph_, "")).value();
  Roster roster_{graph_, "", run_.processes};
  Starter starter_{graph_, options_.facts, options_, run_, roster_};
  Ledger ledger_{graph_, listener_, TimePoint{}};
  RestartPolicy policy_{graph::processes_on(graph_, ""), graph_.supervision};
  const std::string log_name_ = "test";
  Conductor conductor_{[] {}};
  Renewal renewal_{conductor_,
                   {roster_, policy_, starter_, [](Member&, bool) {}, [](const std::string&) {},
                    [] { return false; }, log_name_}};
  const SystemNames names_{graph_, graph_, facts_.ports, roster_.all()};
  Operating operating_{
      conductor_, graph_, facts_, names_, [](const std::string&) { return host::ComponentReport{}; }, {}};
  Exchanging exchanging_{conductor_, graph_, facts_, names_, operating_};
  Applying applying_{
      {conductor_, graph_, facts_, roster_.all(), operating_, exchanging_, starter_, renewal_, ledger_},
      {[this](const GraphSource&) -> Result<CheckedSystem> {
         return CheckedSystem{wanted_, facts_of_parts(wanted_), {}};
       },
       std::nullopt,
       [this](const CheckedSystem& system) {
         graph::go_over(graph_, system.graph);
         is_accepted = true;
       },
       [] { return ok(); }}};
  StagedProcess a_{*roster_.all()[0]};
  StagedProcess b_{*roster_.all()[1]};
  const std::array<StagedProcess*, 2> processes_{&a_, &b_};
  SocketPair pair_ = std::move(make_socket_pair()).value();
  Channel here_{std::move(pair_.host)};
  const std::shared_ptr<Channel> there_ = std::make_shared<Channel>(std::move(pair_.supervisor));
  ReplyPtr reply_ = std::make_shared<Reply>(there_, 1, true);
};

// Both components at another speed, and one more of them in each process.
graph::Graph quicker_and_more() {
  graph::Graph graph =
      graph_of_parts({part("left", "a"), part("right", "b"), part("new_left", "a"), part("new_right", "b")});
  for (graph::ComponentNode& node : graph.components) node.params["speed"] = 1.0;
  return graph;
}

}  // namespace

TEST_CASE("a graph is carried out step by step", "[supervisor][apply]") {
  StagedSystem system;
  CHECK(system.apply(quicker_and_more()).empty());
  CHECK(system.heard == Words{"a: set left 1", "b: set right 1", "a: add new_left", "b: add new_right",
                              "a: configure new_left", "b: configure new_right"});
  CHECK(system.is_accepted);
}

TEST_CASE("if a process ends at any step, all that was done before goes back", "[supervisor][apply]") {
  const auto [lost_at, rest] = GENERATE(table<std::size_t, Words>({
      {0, {}},
      {1, {"a: set left 0.5"}},
      {2, {"b: remove new_right", "b: set right 0.5"}},
      {3, {"a: remove new_left", "a: remove new_left", "a: set left 0.5"}},
      {4, {"b: remove new_right", "b: set right 0.5"}},
      {5, {"a: remove new_left", "a: set left 0.5"}},
  }));
  StagedSystem system;
  const std::string why = system.apply(quicker_and_more(), lost_at);
  CHECK_THAT(why, Contains("process ") && !Contains("could not go back: "));
  REQUIRE(system.heard.size() > lost_at);
  CHECK(Words(system.heard.begin() + static_cast<std::ptrdiff_t>(lost_at) + 1, system.heard.end()) == rest);
  CHECK_FALSE(system.is_accepted);
}
