// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/conclusion.hpp"

#include <catch2/catch.hpp>
#include <map>

using namespace orca;
using namespace orca::supervisor;
using host::RunOutcome;

namespace {

struct Case {
  Case() {
    graph.components.emplace_back().name = "command";
    graph.ends = {"command"};
  }
  host::RunResult result() const {
    host::RunResult result;
    conclusion.fill(result);
    return result;
  }

  graph::Graph graph;
  std::map<std::string, host::ComponentReport> reports{{"command", {}}};
  Conclusion conclusion{graph, [this](const std::string& name) { return reports.at(name); }, "test"};
};

}  // namespace

TEST_CASE("before everything is up a failure is no start, afterwards it is a failed run",
          "[supervisor][conclusion]") {
  const bool is_up = GENERATE(false, true);
  Case c;
  if (is_up) c.conclusion.came_up();
  c.conclusion.fail_with(fail(Code::unavailable, "the process has ended", "command"));
  CHECK(c.conclusion.is_over());
  CHECK(c.result().outcome == (is_up ? RunOutcome::failed : RunOutcome::not_started));
  CHECK(c.result().culprit == "command");
}

TEST_CASE("a run ends when the components that it waits for are done", "[supervisor][conclusion]") {
  Case c;
  c.conclusion.came_up();
  c.conclusion.look_at_ends();
  CHECK_FALSE(c.conclusion.is_over());
  c.reports["command"].state = host::ComponentState::work_done;
  c.conclusion.look_at_ends();
  CHECK(c.conclusion.has_closing_phase());
  CHECK(c.result().outcome == RunOutcome::finished);
}

TEST_CASE("a run whose end has failed still gives the others time to come to rest",
          "[supervisor][conclusion]") {
  Case c;
  c.conclusion.came_up();
  c.reports["command"].has_failed = true;
  c.conclusion.look_at_ends();
  CHECK(c.conclusion.has_closing_phase());
  CHECK(c.result().outcome == RunOutcome::failed);
  Case stopped;
  stopped.conclusion.stop("");
  CHECK_FALSE(stopped.conclusion.has_closing_phase());
}

TEST_CASE("a signal that is no request to stop makes a failed run", "[supervisor][conclusion]") {
  Case asked;
  asked.conclusion.stop("");
  CHECK(asked.result().outcome == RunOutcome::stopped);
  Case failed;
  failed.conclusion.stop("SIGUSR1");
  CHECK(failed.result().outcome == RunOutcome::failed);
  CHECK(failed.result().error->message == "the signal SIGUSR1 ended the run");
}

TEST_CASE("what is found too late makes a good run a failure, and does not replace an error",
          "[supervisor][conclusion]") {
  Case c;
  c.conclusion.came_up();
  c.conclusion.run_out_of_time();
  c.conclusion.fail_late(fail(Code::unavailable, "no space"));
  c.conclusion.fail_late(fail(Code::unavailable, "something else"));
  CHECK(c.result().outcome == RunOutcome::failed);
  CHECK(c.result().error->message == "no space");
  Case never_up;
  never_up.conclusion.stop("");
  never_up.conclusion.fail_late(fail(Code::unavailable, "no space"));
  CHECK(never_up.result().outcome == RunOutcome::stopped);
}

TEST_CASE("a component that ended in WORK_FAILED makes a good run a failure", "[supervisor][conclusion]") {
  Case c;
  c.conclusion.came_up();
  c.conclusion.run_out_of_time();
  c.reports["command"].ended_badly = true;
  c.reports["command"].failure = "it is lost";
  c.conclusion.judge();
  CHECK(c.result().outcome == RunOutcome::failed);
}
