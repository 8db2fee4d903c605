// SPDX-License-Identifier: GPL-3.0-or-later
// A thread that a component starts by itself has no use of the component's ports.
#include <catch2/catch.hpp>

#include "executives.hpp"
#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;

TEST_CASE(
    "calls of ports by a component's own thread are refused on every executive, with one alarm that names "
    "component, port and plugin",
    "[host][alarms][threads]") {
  for (const ExecutiveOptions& executive : all_executives()) {
    RunOptions options;
    options.executive = executive;
    const RecordedRun run = record_run("ends=\"bad\"", R"x(
      <component name="bad" type="test.Stranger" autonomous="true"/>
      <component name="life" type="test.Life"/>
      <connect from="bad.out" to="life.in"/>
      <connect from="bad.poke" to="life.poke"/>
      <connect from="bad.ask" to="life.ask"/>)x",
                                       options);
    INFO(name_of(executive) << ", " << (run.result.error ? run.result.error->text() : ""));
    CHECK(run.result.outcome == RunOutcome::finished);
    REQUIRE(run.alarms.size() == 1);
    CHECK(run.alarms[0].kind() == idl::FOREIGN_THREAD);
    CHECK(run.alarms[0].source() == "bad");
    CHECK(run.alarms[0].severity() == idl::ALARM_WARNING);
    CHECK_THAT(run.alarms[0].text(), Contains("bad.out") && Contains("a thread that runs no component") &&
                                         Contains("/test_stranger.so"));
  }
}
