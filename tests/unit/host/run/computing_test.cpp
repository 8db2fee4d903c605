// SPDX-License-Identifier: GPL-3.0-or-later
// Laps take the time that the graph says, in virtual time only.
#include <catch2/catch.hpp>

#include <algorithm>

#include "executives.hpp"
#include "live_system.hpp"
#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Lines = std::vector<std::string>;

namespace {

// Somebody who arrives each 100 ms, a relay that passes it on, and another one that hears of it.
std::string relay(const std::string& attributes, const std::string& mode = "laps") {
  return R"x(<component name="arriver" type="test.Arriver"/>
    <component name="relay" type="test.Relay" )x" +
         attributes + R"x(><param name="mode" value=")x" + mode + R"x("/></component>
    <component name="end" type="test.Relay"/>
    <component name="life" type="test.Life"/>
    <connect from="arriver.out" to="relay.in"/>
    <connect from="relay.out" to="end.in"/>
    <connect from="relay.poke" to="life.poke"/>
    <connect from="relay.ask" to="life.ask"/>)x";
}

// What the relay, the end and life say within a time.
Lines said(const ExecutiveOptions& executive, const std::string& elements, Duration time,
           const std::string& who = "") {
  LiveSystem live(elements);
  live.run(executive, [&](LiveSystem& run) { run.sleep(time); });
  Lines lines = live.news();
  for (std::string& line : lines)
    line.erase(std::min(line.find(" (mission"), line.size()));  // of the arriver
  std::erase_if(lines, [&](const std::string& line) { return line.find(who) != 0 || line == "configure"; });
  return lines;
}

}  // namespace

TEST_CASE("what a lap gives out is that of its beginning, and comes later by what the lap takes",
          "[host][computing]") {
  const std::string mode = GENERATE("laps", "waits");
  for (const ExecutiveOptions& kind : virtual_executives())
    CHECK(said(kind, relay("takes=\"30 ms\"", mode), 150ms) ==
          Lines{"relay hears 1 after 0 ms", "relay gives 1 after 30 ms", "end hears 1 after 30 ms",
                "end gives 1 after 30 ms", "relay hears 2 after 0 ms", "relay gives 2 after 30 ms",
                "end hears 2 after 30 ms", "end gives 2 after 30 ms"});
}

TEST_CASE("nothing is heard while a lap computes: the next one begins with the latest that waits",
          "[host][computing]") {
  const std::string mode = GENERATE("laps", "waits");
  for (const ExecutiveOptions& kind : virtual_executives())
    CHECK(said(kind, relay("takes=\"230 ms\"", mode), 460ms, "relay") ==
          Lines{"relay hears 1 after 0 ms", "relay gives 1 after 230 ms", "relay hears 3 after 30 ms",
                "relay gives 3 after 260 ms"});
}

TEST_CASE("a lap that gives out nothing takes its time, and so does one that throws", "[host][computing]") {
  const ExecutiveOptions kind = virtual_executives().front();
  CHECK(said(kind, relay("takes=\"230 ms\"", "mute"), 300ms, "relay") ==
        Lines{"relay hears 1 after 0 ms", "relay hears 3 after 30 ms"});
  LiveSystem live(relay("takes=\"30 ms\"", "throws"));
  live.run(kind, [](LiveSystem& run) {
    run.sleep(20ms);
    CHECK(run.state("relay") == ComponentState::work);
    run.sleep(20ms);
    CHECK(run.state("relay") == ComponentState::broken);
  });
}

TEST_CASE("what a lap sends waits for its computing, and everything after that has it behind it",
          "[host][computing]") {
  for (const ExecutiveOptions& kind : virtual_executives())
    CHECK(said(kind, relay("takes=\"30 ms\"", "sends"), 50ms) ==
          Lines{"relay hears 1 after 0 ms", "relay sent 1 after 30 ms", "relay gives 1 after 30 ms",
                "poked by relay", "end hears 1 after 30 ms", "end gives 1 after 30 ms"});
}

TEST_CASE("a handler takes no time, however long the laps of its component do", "[host][computing]") {
  std::string elements = relay("", "sends");
  const std::string life = "type=\"test.Life\"";
  elements.replace(elements.find(life), life.size(), life + " takes=\"10 s\"");
  for (const ExecutiveOptions& kind : virtual_executives())
    CHECK(said(kind, elements, 1ms, "poked") == Lines{"poked by relay"});
}

TEST_CASE("a question is a part of what computes, and does not wait", "[host][computing]") {
  for (const ExecutiveOptions& kind : virtual_executives())
    CHECK(said(kind, relay("takes=\"30 ms\"", "asks"), 50ms, "relay") ==
          Lines{"relay hears 1 after 0 ms", "relay was answered 1 after 0 ms", "relay gives 1 after 30 ms"});
}

TEST_CASE("a component that is to end does not compute to the end, and nobody hears what it would have said",
          "[host][computing]") {
  for (const ExecutiveOptions& kind : virtual_executives())
    CHECK(said(kind, relay("takes=\"10 s\""), 50ms, "relay hears") == Lines{"relay hears 1 after 0 ms"});
  for (const ExecutiveOptions& kind : virtual_executives())
    CHECK(said(kind, relay("takes=\"10 s\""), 50ms, "end").empty());
}

TEST_CASE("an order to a component waits for the end of what it computes", "[host][computing]") {
  LiveSystem live(relay("takes=\"80 ms\""));
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(20ms);
    const TimePoint ordered = run.executive().now();
    CHECK(run.suspend("relay").ok());
    CHECK(run.executive().now() - ordered == 60ms);
  });
}

TEST_CASE("a run counts the laps that computed, and those that were not done when the next was due",
          "[host][computing]") {
  RunOptions options = virtual_run();
  options.until = 950ms;
  const auto counted = [&](const std::string& attributes) {
    return record_run("", relay(attributes), options).result.counters.computing;
  };
  const ComputingCounters in_time = counted("takes=\"30 ms\"").at("relay");
  CHECK(in_time.laps == 10);
  CHECK(in_time.time == 300ms);
  CHECK(in_time.overruns == 0);
  const ComputingCounters overloaded = counted("takes=\"230 ms\"").at("relay");
  CHECK(overloaded.laps == 5);
  CHECK(overloaded.overruns == 4);
  CHECK(counted("").empty());
}

TEST_CASE("a trace hash holds what laps take, and a graph without it has the hash that it had",
          "[host][computing]") {
  RunOptions options = virtual_run();
  options.until = 1s;
  const auto hash = [&](const std::string& attributes) {
    return record_run("", relay(attributes), options).result.trace_hash;
  };
  CHECK(hash("takes=\"0 s\"") == hash(""));
  CHECK(hash("takes=\"30 ms\"") != hash(""));
  const auto once = hash("takes=\"30 ms\"");
  for (const ExecutiveOptions& kind : virtual_executives()) {
    options.executive = kind;
    CHECK(hash("takes=\"30 ms\"") == once);
  }
}

TEST_CASE("in real time the machine computes, and what the graph says of it means nothing",
          "[host][computing]") {
  for (const ExecutiveOptions& kind : steady_executives()) {
    RunOptions options;
    options.executive = kind;
    options.until = 250ms;
    const RecordedRun run = record_run("", relay("takes=\"10 s\""), options);
    INFO(name_of(kind));
    CHECK(run.result.outcome == RunOutcome::time_is_up);
    CHECK(run.result.counters.computing.empty());
    CHECK(run.result.counters.edges.at(1).counters.delivered > 0);  // to the end
    CHECK(run.warnings.empty());
  }
}

TEST_CASE("on one core laps compute one after the other, and on two side by side", "[host][computing]") {
  const auto two = [](const std::string& cores) {
    return "<process name=\"main\"" + cores + R"x(/>
      <component name="arriver" type="test.Arriver"/>
      <component name="first" type="test.Relay" takes="30 ms"/>
      <component name="second" type="test.Relay" takes="40 ms"/>
      <connect from="arriver.out" to="first.in"/><connect from="arriver.out" to="second.in"/>)x";
  };
  for (const ExecutiveOptions& kind : virtual_executives()) {
    const auto gives = [&](const std::string& cores) {
      Lines lines = said(kind, two(cores), 90ms);
      std::erase_if(lines, [](const std::string& line) { return line.find("gives") == std::string::npos; });
      return lines;
    };
    const Lines apart{"first gives 1 after 30 ms", "second gives 1 after 40 ms"};
    CHECK(gives("") == apart);
    CHECK(gives(" cores=\"2\"") == apart);
    CHECK(gives(" cores=\"1\"") == Lines{"first gives 1 after 30 ms", "second gives 1 after 70 ms"});
  }
  RunOptions options = virtual_run();
  options.until = 950ms;
  const auto counted = record_run("", two(" cores=\"1\""), options).result.counters.computing;
  CHECK(counted.at("first").waited == 0s);
  CHECK(counted.at("second").time == 400ms);
  CHECK(counted.at("second").waited == 300ms);
}
