// SPDX-License-Identifier: GPL-3.0-or-later
// The result that an application gets after a run, and the events that it receives meanwhile.
#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <cstdio>

#include "executives.hpp"
#include "orca/idl/time.hpp"
#include "recorded_run.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;
using Lines = std::vector<std::string>;

namespace {

const std::string kArrivals = R"x(
    <component name="arriver" type="test.Arriver"/>
    <component name="host" type="test.Welcomer"/>
    <component name="hostess" type="test.Welcomer"/>
    <connect from="arriver.out" to="host.in"/>
    <connect from="arriver.out" to="hostess.in"/>)x";

const std::string kBrittle = R"x(
    <hardware name="scout" type="test.Brittle"/>
    <component name="base" type="orca.RobotBaseServer" hardware="scout"/>)x";

std::string slow_starter(const std::string& param) {
  return R"x(<component name="late" type="test.SlowStarter"><param )x" + param + "/></component>";
}

}  // namespace

TEST_CASE("a run that ends as the graph says is finished, without culprit or error", "[host][result]") {
  const RecordedRun run = record_run("ends=\"host\"", kArrivals, virtual_run());
  CHECK(run.result.outcome == RunOutcome::finished);
  CHECK(run.result.culprit.empty());
  CHECK_FALSE(run.result.error);
  CHECK(run.result.alarms.empty());
  CHECK(run.heard == Lines{"started", "arrived home", "arrived home", "ended"});
}

TEST_CASE("arrivals are objects, each heard once however many take it, with their stamps on the run's clock",
          "[host][result]") {
  const RecordedRun run = record_run("ends=\"host\"", kArrivals, virtual_run());
  REQUIRE(run.result.arrivals.size() == 2);
  const idl::Arrived& second = run.result.arrivals[1];
  CHECK(second.name() == "home");
  CHECK(second.x() == 2.0);
  CHECK(second.y() == -1.0);
  CHECK(second.origin() == "arriver");
  CHECK(second.seq() == 2);
  CHECK(to_time_point(second.stamp()) - run.result.start == 100ms);
}

TEST_CASE("contacts are objects from the hardware that reports them", "[host][result]") {
  RunOptions options = virtual_run();
  options.until = 700ms;
  const RecordedRun run = record_run("", kBrittle, options);
  CHECK(run.heard == Lines{"started", "contact Dewey", "ended"});
  REQUIRE(run.result.contacts.size() == 1);
  const idl::Contact& contact = run.result.contacts[0];
  CHECK(contact.robot() == "Dewey");
  CHECK(contact.other() == "wall");
  CHECK(contact.x() == 2.0);
  CHECK(contact.origin() == "scout");
  CHECK(to_time_point(contact.stamp()) - run.result.start == 500ms);
}

TEST_CASE("the result counts what went over each connection", "[host][result]") {
  const RecordedRun run = record_run("ends=\"host\"", kArrivals, virtual_run());
  const auto& edges = run.result.counters.edges;
  REQUIRE(edges.size() == 2);
  CHECK(edges[0].from == "arriver.out");
  CHECK(edges[0].to == "host.in");
  CHECK(edges[0].counters.delivered == 2);
  CHECK(edges[0].counters.dropped == 0);
  CHECK(edges[1].to == "hostess.in");
  CHECK(run.result.counters.clients.empty());

  const RecordedRun asked = record_run("ends=\"user\"", R"x(
    <component name="life" type="test.Life"/>
    <component name="user" type="test.User"/>
    <connect from="user.send" to="life.poke"/>
    <connect from="user.query" to="life.ask"/>)x",
                                       virtual_run());
  const RunCounters& counters = asked.result.counters;
  CHECK(counters.edges.empty());
  REQUIRE(counters.clients.contains("user.send"));
  REQUIRE(counters.servers.contains("life.ask"));
  CHECK(counters.clients.at("user.send").answered == 1);
  CHECK(counters.clients.at("user.query").answered == 1);
  CHECK(counters.servers.at("life.poke").accepted == 1);
  CHECK(counters.servers.at("life.ask").accepted == 1);
}

TEST_CASE("in virtual time the result has the trace hash, which is the same each time and on each executive",
          "[host][result]") {
  const auto hash = record_run("ends=\"host\"", kArrivals, virtual_run()).result.trace_hash;
  REQUIRE(hash);
  for (const ExecutiveOptions& executive : virtual_executives()) {
    RunOptions options;
    options.executive = executive;
    CHECK(record_run("ends=\"host\"", kArrivals, options).result.trace_hash == hash);
  }
  RunOptions steady;
  steady.until = 10ms;
  CHECK_FALSE(record_run("", kArrivals, steady).result.trace_hash);
}

TEST_CASE("a run whose time is up says so", "[host][result]") {
  RunOptions options = virtual_run();
  options.until = 150ms;
  CHECK(record_run("", kArrivals, options).result.outcome == RunOutcome::time_is_up);
}

TEST_CASE("a run that can never go on has failed without one culprit", "[host][result]") {
  const RunResult result =
      record_run("", R"x(<component name="idle" type="test.Life"/>)x", virtual_run()).result;
  CHECK(result.outcome == RunOutcome::failed);
  CHECK(result.culprit.empty());
  REQUIRE(result.error);
  CHECK_THAT(result.error->message, Contains("nothing can ever happen again"));
  CHECK(result.trace_hash);
}

TEST_CASE("a component that fails and that the graph waits for is the culprit, with its reason",
          "[host][result]") {
  const RunResult result = record_run("ends=\"host\"", R"x(
    <component name="arriver" type="test.Arriver"/>
    <component name="host" type="test.Welcomer"><param name="deed" value="fail"/></component>
    <connect from="arriver.out" to="host.in"/>)x",
                                      virtual_run())
                               .result;
  CHECK(result.outcome == RunOutcome::failed);
  CHECK(result.culprit == "host");
  REQUIRE(result.error);
  CHECK(result.error->message == "work() failed: nobody is at home");
}

TEST_CASE(
    "a component that has failed at the end makes the run a failure, unless the graph says that it may fail",
    "[host][result]") {
  const auto end_with = [](const std::string& attribute) {
    return record_run("ends=\"counter\"",
                      R"(<component name="bad" type="test.Misbehaving" autonomous="true" )" + attribute +
                          R"(><param name="where" value="work"/></component>
    <component name="counter" type="test.LapCounter"/>)",
                      virtual_run())
        .result;
  };
  const RunResult failed = end_with("");
  CHECK(failed.outcome == RunOutcome::failed);
  CHECK(failed.culprit == "bad");
  REQUIRE(failed.error);
  CHECK_THAT(failed.error->message, Contains("the wheels came off"));
  CHECK(failed.alarms.size() == 1);

  const RunResult excused = end_with(R"(may_fail="true")");
  CHECK(excused.outcome == RunOutcome::finished);
  CHECK_FALSE(excused.error);
  CHECK(excused.alarms.size() == 1);
  CHECK(excused.trace_hash == failed.trace_hash);
}

TEST_CASE("a component that may fail and that the graph waits for ends the run well even so",
          "[host][result]") {
  const RunResult result = record_run("ends=\"host\"", R"x(
    <component name="arriver" type="test.Arriver"/>
    <component name="host" type="test.Welcomer" may_fail="true"><param name="deed" value="fail"/></component>
    <connect from="arriver.out" to="host.in"/>)x",
                                      virtual_run())
                               .result;
  CHECK(result.outcome == RunOutcome::finished);
  CHECK_FALSE(result.error);
}

TEST_CASE("a failure counts although the last client has gone since, but not if the component works again",
          "[host][result]") {
  const auto use = [](const std::string& mode) {
    return record_run("ends=\"user late\"",
                      R"x(
    <component name="life" type="test.Life"><param name="mode" value=")x" +
                          mode + R"x("/></component>
    <component name="user" type="test.User"/>
    <component name="late" type="test.User"><param name="from" value="5"/><param name="until" value="6"/></component>
    <connect from="life.out" to="user.push"/>
    <connect from="life.out" to="late.push"/>)x",
                      virtual_run())
        .result;
  };
  CHECK(use("work fails").outcome == RunOutcome::failed);
  CHECK(use("work fails").culprit == "life");
  CHECK(use("work fails once").outcome == RunOutcome::finished);
}

TEST_CASE("several components that have failed at the end are named together", "[host][result]") {
  RunOptions options = virtual_run();
  options.until = 2s;
  const RunResult result = record_run("", R"x(
    <component name="one" type="test.Life" autonomous="true"><param name="mode" value="work fails"/></component>
    <component name="two" type="test.Life" autonomous="true"><param name="mode" value="work throws"/></component>)x",
                                      options)
                               .result;
  CHECK(result.outcome == RunOutcome::failed);
  CHECK(result.culprit.empty());
  REQUIRE(result.error);
  CHECK(result.error->message == "one, two ended in WORK_FAILED");
}

TEST_CASE("a time limit that comes before the graph's own end says what was not done", "[host][result]") {
  RunOptions options = virtual_run();
  options.until = 50ms;
  const RecordedRun run = record_run("ends=\"host hostess\"", kArrivals, options);
  CHECK(run.result.outcome == RunOutcome::time_is_up);
  CHECK(run.infos ==
        Lines{"orca: the time limit has ended the run before these were done: host (WORK), hostess (WORK)"});
  options.until = 150ms;
  CHECK(record_run("ends=\"host hostess\"", kArrivals, options).infos.empty());
}

TEST_CASE("a component that keeps the system from starting is the culprit, and there is no hash",
          "[host][result]") {
  const RunResult result =
      record_run("", slow_starter(R"(name="refuses" value="true")"), virtual_run()).result;
  CHECK(result.outcome == RunOutcome::not_started);
  CHECK(result.culprit == "late");
  REQUIRE(result.error);
  CHECK_THAT(result.error->message, Contains("the moon is in the wrong phase"));
  CHECK_FALSE(result.trace_hash);
}

TEST_CASE("who looks on is offered a view before anything runs, and the run's hash is the same",
          "[host][result]") {
  RunOptions options = virtual_run();
  const RecordedRun unseen = record_run("ends=\"host\"", kArrivals, options);
  options.looks_on = true;
  const RecordedRun seen = record_run("ends=\"host\"", kArrivals, options);
  CHECK(seen.heard == Lines{"started", "built", "arrived home", "arrived home", "ended"});
  CHECK(seen.result.trace_hash == unseen.result.trace_hash);
  CHECK(seen.result.end - seen.result.start == 100ms);
  CHECK(seen.first_glance.is_virtual);
  CHECK(seen.first_glance.time == Duration{0});
  CHECK(seen.first_glance.working == 0);
  REQUIRE(seen.first_glance.unwell.size() == 3);
  CHECK(seen.first_glance.unwell[0].name == "arriver");
  CHECK(seen.first_glance.unwell[0].state == "INIT");
}

TEST_CASE("options that contradict each other are an outcome, too", "[host][result]") {
  RunOptions options;
  options.executive = {ClockKind::virtual_time, Backend::thread};
  const RecordedRun run = record_run("", kArrivals, options);
  CHECK(run.result.outcome == RunOutcome::bad_options);
  CHECK(run.result.error);
  CHECK(run.heard.empty());
}

TEST_CASE("a file that cannot be written keeps the run from starting", "[host][result]") {
  const TempFolder folder;
  RunOptions options = virtual_run();
  SECTION("the trace") { options.trace_file = folder.file("no/trace"); }
  SECTION("the picture") { options.picture.file = folder.file("no/picture.png"); }
  const RecordedRun run = record_run("ends=\"host\"", kArrivals, options);
  CHECK(run.result.outcome == RunOutcome::not_started);
  REQUIRE(run.result.error);
  CHECK_THAT(run.result.error->message, Contains("No such file or directory"));
  CHECK(run.result.arrivals.empty());
}

TEST_CASE("a picture of hardware that draws nothing is missing at the end, and the run has failed",
          "[host][result]") {
  const TempFolder folder;
  RunOptions options = virtual_run();
  options.until = 700ms;
  options.picture.file = folder.file("picture.png");
  const RunResult result = record_run("", kBrittle, options).result;
  CHECK(result.outcome == RunOutcome::failed);
  REQUIRE(result.error);
  CHECK_THAT(result.error->message, Contains("no simulated hardware"));
}

TEST_CASE("what is logged during a run has the time since its start", "[host][result]") {
  const TempFolder folder;
  const int kept = dup(STDERR_FILENO);
  const int file = open(folder.file("log").c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  dup2(file, STDERR_FILENO);
  RunOptions options = virtual_run();
  options.until = 1500ms;  // the device breaks after 1 s
  const RecordedRun run = record_run("", kBrittle, options);
  std::fflush(stderr);
  dup2(kept, STDERR_FILENO);
  for (const int fd : {kept, file}) close(fd);
  CHECK_THAT(read_text(folder.file("log")), Contains("[     1.000] error   scout: "));
}
