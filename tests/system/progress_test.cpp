// SPDX-License-Identifier: GPL-3.0-or-later
// The line that shows how a run is going, on a terminal that the test holds.
#include <signal.h>

#include <catch2/catch.hpp>

#include <algorithm>

#include "deployer.hpp"
#include "screen.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using Lines = std::vector<std::string>;

namespace {

const std::string kGraph = source_file("graphs/scout_goto.xml");

// The deployer with its stderr on a terminal.
Words on_terminal(const Screen& terminal, const Words& words, const std::string& kind = "xterm") {
  return Words{"/bin/sh", "-c", "exec \"$@\" 2>" + terminal.name(), "sh", "/usr/bin/env", "TERM=" + kind} +
         deployer(words);
}

Run run_on_terminal(const Screen& terminal, const Words& words, const std::string& kind = "xterm") {
  Subprocess program(on_terminal(terminal, words, kind));
  return finish(program, Seconds(30));
}

// Returns all states of the line that were drawn, in order.
Lines drawn(const std::string& bytes) {
  Lines lines;
  for (std::size_t at = 0; (at = bytes.find('\r', at)) != std::string::npos; ++at) {
    const std::size_t end = bytes.find("\x1b[K", at);
    const std::string text = bytes.substr(at + 1, end - at - 1);
    if (end != std::string::npos && !text.empty() && text.find('\n') == std::string::npos)
      lines.push_back(text);
  }
  return lines;
}

bool any_contains(const Lines& lines, const std::string& text) {
  return std::ranges::any_of(lines,
                             [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

Words with_fault(const std::string& where) {
  return Words{system_graph("misbehaving.xml"), "--set", "where=" + where, "--set", "what=exception"} +
         with_test_plugins();
}

}  // namespace

TEST_CASE("on a terminal a line shows time and distance to the goal, and a summary ends the run",
          "[system][progress]") {
  Screen terminal;
  const Run run = run_on_terminal(terminal, {kGraph, "--until", "2 s"});
  CHECK(run.exit_code() == 0);
  const Lines lines = drawn(terminal.all_bytes());
  REQUIRE(lines.size() >= 3);
  CHECK_THAT(lines.front(), Contains(" s"));
  CHECK(any_contains(lines, " s | kitchen 2."));
  CHECK(run.out.empty());
  const Lines screen = screen_after(terminal.all_bytes());
  REQUIRE(screen.size() == 3);
  CHECK_THAT(screen[0], Contains("info    deployer: the time limit"));
  CHECK_THAT(screen[1],
             Contains(" s, no arrivals, no contacts, base has driven 0.") && Contains(" m/s on average"));
  CHECK(screen[2] == "no drops beyond a limit, no missed deadlines, no refusals");
}

TEST_CASE("in virtual time the line has the factor to real time, and changes no hash", "[system][progress]") {
  const Words walk = Words{source_file("graphs/random_walk.xml"), "--until", "1000 s"} + virtual_clock();
  Screen terminal;
  const Run shown = run_on_terminal(terminal, walk);
  const Run hidden = run_deployer(walk);
  REQUIRE(shown.trace_hash());
  CHECK(shown.out == hidden.out);
  CHECK(any_contains(drawn(terminal.all_bytes()), " s simulated, "));
  CHECK(any_contains(drawn(terminal.all_bytes()), " x real time"));
  CHECK_FALSE(hidden.says("simulated"));
}

TEST_CASE("a system in which nothing happens is told while it runs", "[system][progress]") {
  const TempFolder folder;
  const std::string graph =
      folder.write("graph.xml", R"(<graph name="g"><hardware name="scout" type="orca.hw.Sim">
    <param name="world" value=")" + source_file("sim/worlds/office.xml") +
                                    R"("/><param name="robot" value=")" +
                                    source_file("sim/robots/nomad_scout.urdf") +
                                    R"("/><param name="place" value="start"/></hardware>
    <component name="base" type="orca.RobotBaseServer" hardware="scout"/></graph>)");
  Screen terminal;
  CHECK(run_on_terminal(terminal, {graph, "--until", "1.5 s"}).exit_code() == 0);
  CHECK(any_contains(drawn(terminal.all_bytes()), " s | no component works"));
  CHECK(any_contains(screen_after(terminal.all_bytes()), "warning base: has never worked in this run"));
}

TEST_CASE("what is no terminal gets no control character, and on request a summary", "[system][progress]") {
  const Run run = run_deployer({kGraph, "--until", "1 s", "--progress"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says(" s, no arrivals"));
  CHECK(run.out.empty());
  for (const char c : {'\r', '\x1b'}) CHECK(run.err.find(c) == std::string::npos);
  CHECK_FALSE(run_deployer({kGraph, "--until", "1 s"}).says("no arrivals"));
}

TEST_CASE("a terminal that can erase nothing, and a user who wants none, get no line", "[system][progress]") {
  Screen dumb;
  CHECK(run_on_terminal(dumb, {kGraph, "--until", "1 s"}, "dumb").exit_code() == 0);
  CHECK(dumb.all_bytes().find('\x1b') == std::string::npos);
  Screen terminal;
  CHECK(run_on_terminal(terminal, {kGraph, "--until", "1 s", "--no-progress"}).exit_code() == 0);
  CHECK(terminal.all_bytes().find('\x1b') == std::string::npos);
  CHECK(screen_after(terminal.all_bytes()).size() == 1);  // the time limit
}

TEST_CASE("the line is narrower than the terminal", "[system][progress]") {
  Screen terminal(30);
  const std::string goal = "goals=" + std::string(100, 'x') + ": 3.6 6";
  CHECK(run_on_terminal(terminal, {kGraph, "--set", goal, "--until", "1 s"}).exit_code() == 0);
  const Lines lines = drawn(terminal.all_bytes());
  REQUIRE_FALSE(lines.empty());
  for (const std::string& line : lines) CHECK(line.size() <= 29);
  CHECK(any_contains(lines, "xxx..."));
}

TEST_CASE("a component that is not well and the last alarm are in the line, and log lines stay whole",
          "[system][progress]") {
  Screen terminal(200);
  const Run run = run_on_terminal(terminal, with_fault("work"));
  CHECK(run.exit_code() == 0);
  CHECK(any_contains(drawn(terminal.all_bytes()), " s | bad WORK_FAILED | alarm: bad FAILED: work() threw"));
  const Lines screen = screen_after(terminal.all_bytes());
  INFO(terminal.all_bytes());
  REQUIRE(screen.size() > 10);  // the poker tells each lap
  for (const std::string& line : Lines(screen.begin(), screen.end() - 2)) {
    CAPTURE(line);
    CHECK(line.starts_with("[ "));
    CHECK(line.find("alarm: bad FAILED") == std::string::npos);
  }
  CHECK_THAT(screen.back(), Contains("refusals"));
}

TEST_CASE("a signal leaves nothing of the line", "[system][progress]") {
  for (const int signal : {SIGINT, SIGTERM}) {
    Screen terminal;
    Subprocess program(on_terminal(terminal, {kGraph}));
    REQUIRE(terminal.receives("kitchen"));
    program.send(signal);
    CHECK(finish(program, Seconds(10)).exit_code() == 0);
    const Lines screen = screen_after(terminal.all_bytes());
    REQUIRE(screen.size() == 2);  // the summary
    CHECK_THAT(screen[1], Contains("refusals"));
    CHECK(terminal.all_bytes().ends_with("\n"));
  }
}

TEST_CASE("the last words of a process that crashes stand in a line of their own", "[system][progress]") {
  Screen terminal;
  const Run run = run_on_terminal(
      terminal, Words{system_graph("crash_on_the_way.xml"), "--set", "deed=segfault", "--in-process"} +
                    with_test_plugins());
  CHECK(run.exit_code() != 0);
  if (!kSanitized) CHECK(run.ending.signal == SIGSEGV);
  REQUIRE_FALSE(drawn(terminal.all_bytes()).empty());
  const Lines screen = screen_after(terminal.all_bytes());
  CHECK(std::ranges::any_of(screen, [](const auto& line) { return line.starts_with("error: bad: "); }));
  CHECK_FALSE(any_contains(screen, " s | "));
}

TEST_CASE("while a component asks the user there is no line", "[system][progress]") {
  Screen terminal;
  Subprocess::Options waits;
  waits.keep_input_open = true;
  Subprocess program(on_terminal(terminal, {kGraph, "--set", "goals="}), waits);
  REQUIRE(terminal.receives("empty line to end)? "));
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // three times as long as the line takes
  CHECK(terminal.bytes().ends_with("empty line to end)? "));
  program.write_input("near: 3.6 6\n");
  CHECK(terminal.receives(" s | near "));
  program.close_input();
  program.send(SIGINT);
  CHECK(finish(program, Seconds(10)).exit_code() == 0);
}

TEST_CASE("to ask for progress and for none is an error", "[system][progress]") {
  const Run run = run_deployer({kGraph, "--progress", "--no-progress"});
  CHECK(run.exit_code() == 2);
  CHECK(run.says("command line: error C004: --progress and --no-progress exclude each other"));
}
