// SPDX-License-Identifier: GPL-3.0-or-later
// How runs end, in one process and in several.
#include "orca/host/conclusion.hpp"

#include <catch2/catch.hpp>
#include <map>

using namespace orca;
using namespace orca::host;

namespace {

// A run that waits for two components, a and b.
struct EndingRun {
  EndingRun() {
    graph.ends = {"a", "b"};
    for (const std::string& name : graph.ends) graph.components.emplace_back().name = name;
  }
  RunResult result() const {
    RunResult result;
    conclusion.fill(result);
    return result;
  }
  void done(const std::string& name) { reports[name].state = ComponentState::work_done; }
  void failed(const std::string& name, const std::string& why) {
    reports[name] = {ComponentState::idle, true, true, true, why};
  }
  // Returns whether the run is over.
  bool look() {
    conclusion.look_at_ends();
    CHECK(conclusion.has_closing_phase() == conclusion.is_over());
    return conclusion.is_over();
  }

  graph::Graph graph;
  std::map<std::string, ComponentReport> reports{{"a", {}}, {"b", {}}};
  Conclusion conclusion{graph, [this](const std::string& name) { return reports.at(name); }, "test"};
};

// The same, after everything has come up.
struct RunUp : EndingRun {
  RunUp() { conclusion.came_up(); }
};

}  // namespace

TEST_CASE("before everything is up a failure is no start, afterwards it is a failed run",
          "[host][conclusion]") {
  const bool is_up = GENERATE(false, true);
  EndingRun c;
  if (is_up) c.conclusion.came_up();
  c.conclusion.fail_with(fail(Code::unavailable, "the process has ended", "a"));
  CHECK(c.conclusion.is_over());
  CHECK(c.result().outcome == (is_up ? RunOutcome::failed : RunOutcome::not_started));
  CHECK(c.result().culprit == "a");
}

TEST_CASE("a run without ends never comes to an end by itself", "[host][conclusion]") {
  RunUp c;
  c.graph.ends.clear();
  c.done("a");
  c.done("b");
  CHECK_FALSE(c.look());
}

TEST_CASE("a run has ended when all that it waits for are done", "[host][conclusion]") {
  RunUp c;
  c.done("a");
  CHECK_FALSE(c.look());
  c.done("b");
  CHECK(c.look());
  CHECK(c.result().outcome == RunOutcome::finished);
}

TEST_CASE("a run has failed as soon as one of them has that may not", "[host][conclusion]") {
  RunUp c;
  c.failed("b", "no way");
  CHECK(c.look());
  CHECK(c.result().outcome == RunOutcome::failed);
  CHECK(c.result().error->message == "no way");
  CHECK(c.result().culprit == "b");
}

TEST_CASE("one that may fail counts as done when it has failed", "[host][conclusion]") {
  RunUp c;
  c.graph.components[1].may_fail = true;
  c.failed("b", "no way");
  CHECK_FALSE(c.look());
  c.done("a");
  CHECK(c.look());
  c.conclusion.judge();
  CHECK(c.result().outcome == RunOutcome::finished);
}

TEST_CASE("with other machines a run is done when it is on all of them, and fails at once",
          "[host][conclusion]") {
  RunUp c;
  const auto not_everywhere = [](bool) { return false; };
  c.done("a");
  c.done("b");
  c.conclusion.look_at_ends(not_everywhere);
  CHECK_FALSE(c.conclusion.is_over());
  c.failed("b", "no way");
  c.conclusion.look_at_ends(not_everywhere);
  CHECK(c.result().outcome == RunOutcome::failed);
}

TEST_CASE("a signal that is no request to stop makes a failed run", "[host][conclusion]") {
  RunUp asked;
  asked.conclusion.stop("");
  CHECK(asked.result().outcome == RunOutcome::stopped);
  CHECK_FALSE(asked.conclusion.has_closing_phase());
  RunUp failed;
  failed.conclusion.stop("SIGUSR1");
  CHECK(failed.result().outcome == RunOutcome::failed);
  CHECK(failed.result().error->message == "the signal SIGUSR1 ended the run");
}

TEST_CASE("what is found too late makes a good run a failure, and does not replace an error",
          "[host][conclusion]") {
  RunUp c;
  c.conclusion.run_out_of_time();
  c.conclusion.fail_late(fail(Code::unavailable, "no space"));
  c.conclusion.fail_late(fail(Code::unavailable, "something else"));
  CHECK(c.result().outcome == RunOutcome::failed);
  CHECK(c.result().error->message == "no space");
  EndingRun never_up;
  never_up.conclusion.stop("");
  never_up.conclusion.fail_late(fail(Code::unavailable, "no space"));
  CHECK(never_up.result().outcome == RunOutcome::stopped);
}

TEST_CASE("a good run in which components ended in WORK_FAILED has failed, and names them",
          "[host][conclusion]") {
  RunUp c;
  c.conclusion.run_out_of_time();
  c.failed("b", "it is lost");
  SECTION("one") {
    c.conclusion.judge();
    CHECK(c.result().error->message == "it is lost");
    CHECK(c.result().culprit == "b");
  }
  SECTION("two") {
    c.failed("a", "nor here");
    c.conclusion.judge();
    CHECK(c.result().error->message == "a, b ended in WORK_FAILED");
  }
  CHECK(c.result().outcome == RunOutcome::failed);
}
