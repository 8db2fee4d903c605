// SPDX-License-Identifier: GPL-3.0-or-later
// The end of a run that somebody stops: who ends first is no trouble to the others.
#include <catch2/catch.hpp>

#include <algorithm>

#include "executives.hpp"
#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Words = std::vector<std::string>;

namespace {

// Runs a receiver and a component that sends to it in one lap without end.
RecordedRun run_insister(const ExecutiveOptions& executive, Duration until, const std::string& pause) {
  RunOptions options;
  options.executive = executive;
  options.until = until;
  return record_run("",
                    R"(<component name="receiver" type="test.Life" priority="5"/>
    <component name="sender" type="test.Insister" priority="-5"><param name="pause" value=")" +
                        pause + R"("/></component>
    <connect from="sender.goal" to="receiver.poke"/>)",
                    options);
}

void check_quiet_end(const RecordedRun& run) {
  CHECK(run.result.outcome == RunOutcome::time_is_up);
  CHECK(run.heard == Words{"started", "ended"});
  CHECK(std::ranges::all_of(run.warnings,
                            [](const std::string& line) { return line.find(" is full") < line.size(); }));
  CHECK(std::ranges::count(run.infos, "sender: begins") == 1);
  CHECK(run.infos.back() == "sender: stops, though refused");
}

}  // namespace

TEST_CASE("a lap that goes on when its server has ended already ends without a word, then stop() runs",
          "[host][ending]") {
  check_quiet_end(run_insister({ClockKind::steady, Backend::thread}, 200ms, "0"));
}

TEST_CASE("who ends first at one instant of virtual time is no trouble to the others", "[host][ending]") {
  for (const ExecutiveOptions& kind : virtual_executives()) check_quiet_end(run_insister(kind, 2s, "1 s"));
}

TEST_CASE("a configure() that waits when the system ends is no failure", "[host][ending]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    RunOptions options;
    options.executive = kind;
    options.until = 2s;
    const RecordedRun run = record_run("", R"(
      <component name="life" type="test.Life" start="on_demand"><param name="mode" value="configure waits"/></component>
      <component name="user" type="test.User"/>
      <connect from="life.out" to="user.push"/>)",
                                       options);
    CHECK(run.result.outcome == RunOutcome::time_is_up);
    CHECK(run.heard == Words{"started", "ended"});
    CHECK(run.alarms.empty());
  }
}
