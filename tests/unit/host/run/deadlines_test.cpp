// SPDX-License-Identifier: GPL-3.0-or-later
// What a run reports about the deadlines of its connections.
#include <catch2/catch.hpp>

#include "executives.hpp"
#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;
using Lines = std::vector<std::string>;

namespace {

// An arriver that pushes each 100 ms to a host that waits for its objects.
std::string arrivals(const std::string& policy) {
  return R"x(
    <component name="arriver" type="test.Arriver"/>
    <component name="host" type="test.Welcomer"/>
    <connect from="arriver.out" to="host.in")x" +
         policy + "/>";
}

}  // namespace

TEST_CASE("a missed deadline is a warning of the component that waits for the object, and a number",
          "[host][deadline]") {
  for (const ExecutiveOptions& executive : virtual_executives()) {
    RunOptions options;
    options.executive = executive;
    const RecordedRun late = record_run("ends=\"host\"", arrivals(" deadline=\"30 ms\""), options);
    CHECK(late.warnings == Lines{"host: arriver.out to host.in: no object within the deadline of 0.03 s"});
    CHECK(late.result.counters.edges[0].counters.missed_deadlines == 3);
    const RecordedRun in_time = record_run("ends=\"host\"", arrivals(" deadline=\"100 ms\""), options);
    CHECK(in_time.warnings.empty());
    CHECK(in_time.result.trace_hash == late.result.trace_hash);
  }
}

TEST_CASE("a missed deadline is reported in real time, too", "[host][deadline]") {
  for (const ExecutiveOptions& executive : steady_executives()) {
    INFO(name_of(executive));
    RunOptions options;
    options.executive = executive;
    const RecordedRun run = record_run("ends=\"host\"", arrivals(" deadline=\"30 ms\""), options);
    CHECK(run.warnings == Lines{"host: arriver.out to host.in: no object within the deadline of 0.03 s"});
  }
}

TEST_CASE("deadlines do not hide that nothing can ever happen again", "[host][deadline]") {
  const RecordedRun run = record_run("", R"x(
    <component name="a" type="test.Life" autonomous="true"><param name="mode" value="waits"/></component>
    <component name="b" type="test.Life" autonomous="true"><param name="mode" value="waits"/></component>
    <connect from="a.out" to="b.in" deadline="1 s"/>
    <connect from="b.out" to="a.in" deadline="2 s"/>)x",
                                     virtual_run());
  REQUIRE(run.result.error);
  CHECK_THAT(run.result.error->message, Contains("nothing can ever happen again"));
  CHECK(run.warnings == Lines{"b: a.out to b.in: no object within the deadline of 1 s",
                              "a: b.out to a.in: no object within the deadline of 2 s",
                              "orca: no connection has carried anything in this run"});
}
