// SPDX-License-Identifier: GPL-3.0-or-later
#include "starting/adoption.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "agreed/graph_mark.hpp"
#include "agreed/run_wishes.hpp"
#include "channel/samples.hpp"
#include "hosted/vigil.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/supervisor/meeting_place.hpp"
#include "runtime_folder.hpp"

using namespace orca;
using namespace orca::supervisor;
using orca::test::null_device;
using orca::test::RuntimeFolder;

namespace {

class Deaf final : public host::RunListener {
 public:
  [[noreturn]] void abandon(const host::RunResult& /*result*/) override { std::abort(); }
};

graph::Graph one_process() {
  graph::Graph graph;
  graph.name = "scout";
  graph::ComponentNode node;
  node.name = "avoid";
  node.process = "main";
  graph.components.push_back(node);
  return graph;
}

// A run that another supervisor has begun, whose only process waits.
class WaitingRun {
 public:
  WaitingRun(std::uint64_t mark, std::string run) : mark_(mark), run_(std::move(run)) {}
  ~WaitingRun() {
    ending_ = true;
    thread_.join();
  }
  WaitingRun(const WaitingRun&) = delete;
  WaitingRun& operator=(const WaitingRun&) = delete;

 private:
  void work() {
    while (!ending_) {
      (void)vigil_.turn(Moment::clock::now());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  Orphaned introduce() {
    RunWishes wishes;
    wishes.epoch = epoch_;
    wishes.start = TimePoint{42s};
    wishes.run = run_;
    return {"main", mark_, to_pairs(wishes), page_.descriptor(), null_device(), {}, {"main"}};
  }

  const std::uint64_t mark_;
  const std::string run_;
  const Duration epoch_ = steady_epoch();  // before the test, which plays another process, changes its own
  const RunPage page_ = *RunPage::create(1, 1);
  const ControlSocket place_ = *open_meeting_place("scout", "main");
  Vigil vigil_{place_, [this] { return introduce(); }};
  std::atomic<bool> ending_{false};
  std::thread thread_{[this] { work(); }};
};

}  // namespace

TEST_CASE("where nobody waits a new run begins", "[supervisor][adoption]") {
  const RuntimeFolder folder;
  const Result<Beginning> beginning = begin_or_go_on(one_process(), "");
  REQUIRE(beginning);
  CHECK_FALSE(beginning->run.is_inherited);
  CHECK(beginning->processes.empty());
  CHECK(begin_or_go_on(one_process(), "")->run.name != beginning->run.name);
}

TEST_CASE("the run of processes that wait goes on", "[supervisor][adoption]") {
  const RuntimeFolder folder;
  const WaitingRun waiting(mark_of(graph::print(one_process())), "seven");
  const Result<Beginning> beginning = begin_or_go_on(one_process(), "");
  REQUIRE(beginning);
  CHECK(beginning->run.is_inherited);
  CHECK(beginning->run.name == "seven");
  CHECK(beginning->run.start == TimePoint{42s});
  REQUIRE(beginning->processes.size() == 1);
  CHECK(beginning->processes[0].name == "main");
  CHECK(beginning->processes[0].pid == getpid());
}

TEST_CASE("processes of another graph are no part of this one", "[supervisor][adoption]") {
  const RuntimeFolder folder;
  const WaitingRun waiting(mark_of(graph::print(one_process())) + 1, "seven");
  const Result<Beginning> beginning = begin_or_go_on(one_process(), "");
  REQUIRE_FALSE(beginning);
  CHECK(beginning.error().code == Code::failed_precondition);
  CHECK_THAT(beginning.error().message,
             Catch::Contains("main") && Catch::Contains("orcactl --system scout stop"));
}

TEST_CASE("the doorbells of a run are those that any of its processes knows", "[supervisor][adoption]") {
  CHECK(joined_names({{"a", "b"}, {"a", "b", "", "d"}, {"a", "b", "c"}}) ==
        std::vector<std::string>{"a", "b", "c", "d"});
  CHECK(joined_names({{"a"}, {"a", "", "c"}}) == std::vector<std::string>{"a", "", "c"});
}

TEST_CASE("what was gone is started again unless its rule is never to", "[supervisor][adoption]") {
  const graph::Graph graph = one_process();
  Deaf deaf;
  Ledger ledger(graph, deaf, TimePoint{});
  graph::ProcessNode node;
  node.name = "main";
  node.restart = GENERATE(graph::Restart::permanent, graph::Restart::transient, graph::Restart::temporary);
  RestartPolicy policy({node}, {});
  CHECK(note_gone(Member(node, 0, 0), ledger, policy).message ==
        "process main was gone when this deployer came");
  CHECK(policy.has_finished(0) == (node.restart == graph::Restart::temporary));
  REQUIRE(ledger.alarms().size() == 1);
  CHECK(ledger.alarms()[0].alarm.kind() == idl::PROCESS_ENDED);
}
