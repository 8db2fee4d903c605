// SPDX-License-Identifier: GPL-3.0-or-later
// Processes that begin anew with another graph. The test plays them, and what else the supervisor does with them.
#include "starting/renewal.hpp"

#include <array>
#include <catch2/catch.hpp>

#include "orca/graph/placement.hpp"
#include "staged_process.hpp"

using namespace orca;
using namespace orca::supervisor;
using Catch::Contains;
using orca::test::StagedProcess;
using Words = std::vector<std::string>;

namespace {

graph::Graph a_and_b() {
  graph::Graph graph;
  graph.name = "two";
  for (const char* const name : {"a", "b"}) {
    graph::ComponentNode node;
    node.name = std::string(name) + "_component";
    node.process = name;
    graph.components.push_back(node);
    graph.processes.push_back({.name = name});
  }
  return graph;
}

// A run whose process "a" is to begin anew, beside "b".
class RenewedRun {
 public:
  RenewedRun() {
    for (StagedProcess* const process : {&a, &b}) process->start(Member::Phase::up);
  }

  void play(const std::function<void()>& test) {
    conductor_.run([&] {
      conductor_.begin("renewal", [this] {
        const Status done = renewal_.carry_out({{"a"},
                                                [this] { said.emplace_back("the new graph"); },
                                                [this] { said.emplace_back("the old graph"); }});
        said.push_back(done.ok() ? "done" : done.error().text());
      });
      test();
    });
  }
  void turn(Moment now = Moment::clock::now()) { conductor_.go_on(now); }

  // The process ends.
  void end(StagedProcess& process, const std::string& how = "has ended", bool is_normal = true) {
    process.end();
    if (!renewal_.lose(process.member(), is_normal, how))
      said.push_back(process.member().name() + " is lost");
    turn();
  }
  // The process ends by a fault of its own, and is started again.
  void lose_and_start_again(StagedProcess& process) {
    end(process, "was killed by signal 9", false);
    (void)policy_.ended(process.member().index(), false, Moment::clock::now());
    start_due(Member::Phase::coming_up);
  }
  // Starts what is due.
  void start_due(Member::Phase phase) {
    for (const std::size_t index : policy_.take_due(Moment::clock::now())) {
      StagedProcess& process = *std::array{&a, &b}.at(index);
      renewal_.note_start(process.member());
      process.start(phase);
      said.push_back(process.member().name() + " begins");
    }
    turn();
  }

 private:
  const graph::Graph graph_ = a_and_b();
  const SupervisedOptions options_{};
  const RunIdentity run_ = std::move(begin_run(graph_, "")).value();
  Roster roster_{graph_, "", run_.processes};
  Starter starter_{graph_, options_.facts, options_, run_, roster_};
  RestartPolicy policy_{graph::processes_on(graph_, ""), graph_.supervision};
  const std::string log_name_ = "test";
  Conductor conductor_{[] {}};

 public:
  StagedProcess a{*roster_.all()[0]};
  StagedProcess b{*roster_.all()[1]};
  Words said;
  bool is_over = false;

 private:
  Renewal renewal_{conductor_,
                   {roster_, policy_, starter_,
                    [this](Member& member, bool keeps_states) {
                      said.push_back(member.name() + (keeps_states ? " keeps its states and ends" : " ends"));
                    },
                    [](const std::string&) {}, [this] { return is_over; }, log_name_}};
};

}  // namespace

TEST_CASE("a process ends, then the graph changes, then it begins", "[supervisor][renewal]") {
  RenewedRun run;
  run.play([&] {
    CHECK(run.said == Words{"a keeps its states and ends"});
    run.end(run.a);
    CHECK(run.said.back() == "the new graph");
    run.start_due(Member::Phase::coming_up);
    CHECK(run.said.back() == "a begins");
    run.a.member().enter(Member::Phase::up);
    run.turn();
    CHECK(run.said == Words{"a keeps its states and ends", "the new graph", "a begins", "done"});
  });
}

TEST_CASE("if it does not come up, it ends and begins as before", "[supervisor][renewal]") {
  RenewedRun run;
  std::string why;
  run.play([&] {
    run.end(run.a);
    run.start_due(Member::Phase::coming_up);
    SECTION("because it ends") {
      run.end(run.a, "was killed by signal 11", false);
      why = "process a was killed by signal 11";
    }
    SECTION("because it takes too long") {
      run.turn(Moment::clock::now() + kStartLimit + 1s);
      CHECK(run.said.back() == "a ends");
      run.end(run.a);
      why = "not everything came up in time";
    }
    CHECK(run.said.back() == "the old graph");
    run.start_due(Member::Phase::up);
    CHECK(run.said.back() == why);
  });
}

TEST_CASE("another process that begins with the new graph meanwhile goes back with it",
          "[supervisor][renewal]") {
  RenewedRun run;
  run.play([&] {
    run.end(run.a);
    run.start_due(Member::Phase::coming_up);
    run.lose_and_start_again(run.b);
    CHECK(run.said ==
          Words{"a keeps its states and ends", "the new graph", "a begins", "b is lost", "b begins"});
    run.end(run.a, "was killed by signal 11", false);
    CHECK(run.said.back() == "b ends");
    run.end(run.b);
    CHECK(run.said.back() == "the old graph");
    run.start_due(Member::Phase::up);
    CHECK(run.said.back() == "process a was killed by signal 11");
  });
}

TEST_CASE("a process that is lost on the way back is started by its own rule", "[supervisor][renewal]") {
  RenewedRun run;
  run.play([&] {
    run.end(run.a);
    run.start_due(Member::Phase::coming_up);
    run.end(run.a, "was killed by signal 11", false);
    run.start_due(Member::Phase::coming_up);
    run.end(run.a, "was killed by signal 9", false);
    CHECK_THAT(run.said[run.said.size() - 2], Contains("a is lost"));
    CHECK(run.said.back() == "process a was killed by signal 11; and process a was killed by signal 9");
  });
}

TEST_CASE("nothing begins anew any more when the run is over", "[supervisor][renewal]") {
  RenewedRun run;
  run.play([&] {
    run.is_over = true;
    run.turn();
    CHECK(run.said ==
          Words{"a keeps its states and ends", "the run ends before all processes have begun anew"});
  });
}
