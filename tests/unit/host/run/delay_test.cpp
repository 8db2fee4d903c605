// SPDX-License-Identifier: GPL-3.0-or-later
// Objects between processes and machines are under way for as long as the graph says, in virtual time only.
#include <catch2/catch.hpp>

#include <algorithm>

#include "recorded_run.hpp"
#include "swap_order.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Words = std::vector<std::string>;

namespace {

// Somebody who arrives each 100 ms, and a relay that passes it on, sends and asks; each of the three in a process.
std::string three_apart(const std::string& places, const std::string& mode) {
  return places + R"x(<component name="arriver" type="test.Arriver" process="a"/>
    <component name="relay" type="test.Relay" process="b"><param name="mode" value=")x" +
         mode + R"x("/></component>
    <component name="end" type="test.Relay" process="c"/>
    <component name="life" type="test.Life" process="c"/>
    <connect from="arriver.out" to="relay.in"/>
    <connect from="relay.out" to="end.in"/>
    <connect from="relay.poke" to="life.poke"/>
    <connect from="relay.ask" to="life.ask"/>)x";
}

std::string three_processes(const std::string& a, const std::string& b, const std::string& c) {
  return "<process name='a' " + a + "/><process name='b' " + b + "/><process name='c' " + c + "/>";
}

// What is said within a time about the first object.
Words heard_of_first(const ExecutiveOptions& executive, const std::string& elements, Duration time) {
  LiveSystem live(elements);
  live.run(executive, [&](LiveSystem& run) { run.sleep(time); });
  Words lines = live.news();
  std::erase_if(lines, [](const std::string& line) { return line.find(" 1 ") == std::string::npos; });
  for (std::string& line : lines) line.erase(std::min(line.find(" (mission"), line.size()));
  return lines;
}

}  // namespace

TEST_CASE("an object that goes to another process arrives later by the delays of both", "[host][delay]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    CHECK(heard_of_first(kind, three_apart(three_processes("delay='5 ms'", "delay='3 ms'", ""), "laps"),
                         90ms) == Words{"relay hears 1 after 8 ms", "relay gives 1 after 8 ms",
                                        "end hears 1 after 11 ms", "end gives 1 after 11 ms"});
    CHECK(heard_of_first(kind, three_apart(three_processes("", "", "delay='40 ms'"), "sends"), 180ms) ==
          Words{"relay hears 1 after 0 ms", "relay sent 1 after 80 ms", "relay gives 1 after 80 ms",
                "end hears 1 after 120 ms", "end gives 1 after 120 ms"});
    CHECK(heard_of_first(kind, three_apart(three_processes("", "", "delay='20 ms'"), "asks"), 90ms).at(1) ==
          "relay was answered 1 after 40 ms");
  }
}

TEST_CASE("an object that goes to another machine takes the delay of both machines in addition",
          "[host][delay]") {
  const std::string machines = "<machine name='m' delay='30 ms'/><machine name='n' delay='1 ms'/>";
  const ExecutiveOptions kind = virtual_executives().front();
  CHECK(heard_of_first(
            kind,
            machines + three_apart(three_processes("machine='m' delay='2 ms'", "machine='m'", "machine='n'"),
                                   "laps"),
            90ms) == Words{"relay hears 1 after 2 ms", "relay gives 1 after 2 ms", "end hears 1 after 33 ms",
                           "end gives 1 after 33 ms"});
}

TEST_CASE("a trace hash holds the delays, and a graph without them has the hash that it had",
          "[host][delay]") {
  RunOptions options = virtual_run();
  options.until = 1s;
  const auto hash = [&](const std::string& of_c) {
    return record_run("", three_apart(three_processes("", "", of_c), "laps"), options).result.trace_hash;
  };
  const auto without = hash("");
  CHECK(hash("delay='0 s'") == without);
  const auto once = hash("delay='7 ms'");
  CHECK(once != without);
  for (const ExecutiveOptions& kind : virtual_executives()) {
    options.executive = kind;
    CHECK(hash("delay='7 ms'") == once);
  }
}

TEST_CASE("in real time links take what they take, and what the graph says of it means nothing",
          "[host][delay]") {
  for (const ExecutiveOptions& kind : steady_executives()) {
    RunOptions options;
    options.executive = kind;
    options.until = 250ms;
    const RecordedRun run =
        record_run("", three_apart(three_processes("", "", "delay='10 s'"), "laps"), options);
    INFO(name_of(kind));
    CHECK(run.result.counters.edges.at(1).counters.delivered > 0);  // to the end
  }
}

TEST_CASE("an exchange of code loses nothing, doubles nothing and keeps the order of what is under way",
          "[host][delay][swap]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    std::string pair = kPair;
    pair.replace(pair.find(" type=\"test.Teller\""), 0, " process=\"afar\"");
    LiveSystem live("<process name='afar' delay='25 ms'/>" + pair);
    live.run(kind, [](LiveSystem& run) {
      run.sleep(200ms);
      const Result<SwapReport> done = swap(run, next_teller("test_teller_2"));
      INFO((done ? "" : done.error().text()));
      REQUIRE(done);
      run.sleep(200ms);
    });
    const Words said = live.news();
    CHECK(beginning(said, "gap").empty());
    CHECK(beginning(said, "poke").empty());
    CHECK(beginning(said, "not sent").empty());
    CHECK_FALSE(beginning(said, "heard 1:").empty());
    CHECK_FALSE(beginning(said, "heard 2:").empty());
  }
}
