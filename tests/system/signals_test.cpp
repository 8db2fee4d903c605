// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C at any moment stops the robot, leaves nothing behind and exits 0 within 3 s.
#include <signal.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <future>
#include <random>
#include <thread>

#include "deployer.hpp"
#include "temp_folder.hpp"
#include "trace_file.hpp"

using namespace orca::test;

namespace {

constexpr double kEndLimit = 3.0 * (kSanitized ? 3.0 : 1.0);  // [s]

void sleep_for(double seconds) { std::this_thread::sleep_for(Seconds(seconds)); }

// Signals the whole group for SIGINT, as a terminal does, and else the program alone, as `kill` does.
void stop(const Subprocess& program, int signal) {
  signal == SIGINT ? program.send_to_group(signal) : program.send(signal);
}

struct Stopped {
  Run run;
  Seconds took{0};
  bool left_behind = true;
};

Stopped stop_after(double instant, int signal, const Words& more = {}) {
  Subprocess program(deployer(Words{source_file("graphs/scout_goto.xml")} + more));
  sleep_for(instant);
  const auto sent = std::chrono::steady_clock::now();
  stop(program, signal);
  Stopped stopped{finish(program, Seconds(20)), {}, true};
  stopped.took = std::chrono::steady_clock::now() - sent;
  stopped.left_behind = program.group_lives();
  return stopped;
}

void check_stopped(const Stopped& stopped) {
  INFO(stopped.run.err);
  CHECK(stopped.run.ended);
  CHECK(stopped.run.exit_code() == 0);
  CHECK(stopped.took < Seconds(kEndLimit));
  CHECK_FALSE(stopped.left_behind);
}

// Sends a signal to a robot that drives in real time.
Run end_driving_robot(int signal, const std::string& trace, const Words& more = {}) {
  Subprocess program(deployer(Words{source_file("graphs/scout_goto.xml"), "--trace", trace} + more));
  // On a busy machine a second may pass before the program has opened its files.
  for (int i = 0; i < 100 && !std::filesystem::exists(trace); ++i) sleep_for(0.1);
  sleep_for(1.0 * (kSanitized ? 4.0 : 1.0));
  program.send(signal);
  return finish(program, Seconds(kEndLimit));
}

void check_at_rest(const std::string& trace_file) {
  const TraceFile trace(trace_file);
  REQUIRE(trace.has("state", {"scout", "Ready", "Active"}));
  CHECK(trace.state_before("scout") == "Closed");
}

// Makes the signals of a terminal end programs again, if whoever started the test has made it ignore them.
void stop_ignoring_terminal() {
  for (const int of_terminal : {SIGHUP, SIGINT, SIGQUIT}) ::signal(of_terminal, SIG_DFL);
}

Words greedy() { return Words{system_graph("hog.xml"), "--set", "how=one_lap"} + with_test_plugins(); }

}  // namespace

TEST_CASE(
    "at ten instants of the first three seconds SIGINT and SIGTERM end the run with 0 within 3 s, and no "
    "process is left",
    "[system][signals]") {
  constexpr unsigned kSeed = 20040611;
  std::mt19937 random(kSeed);
  std::vector<std::pair<double, std::future<Stopped>>> stops;
  for (int i = 0; i < 10; ++i) {
    const double instant =
        std::max(0.2, 3.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()));
    stops.emplace_back(instant,
                       std::async(std::launch::async, stop_after, instant, i % 2 == 0 ? SIGINT : SIGTERM,
                                  Words{"--name", "stopped_" + std::to_string(i)}));
  }
  for (auto& [instant, stopped] : stops) {
    CAPTURE(kSeed, instant);
    check_stopped(stopped.get());
  }
}

TEST_CASE(
    "a signal during the start either comes before the program can act on it, and ends it, or stops it with "
    "0",
    "[system][signals]") {
  for (int i = 0; i < 20; ++i) {
    const double instant = 0.005 * i;
    const int signal = i % 2 == 0 ? SIGINT : SIGTERM;
    CAPTURE(instant, signal);
    const Stopped stopped = stop_after(instant, signal);
    INFO(stopped.run.err);
    CHECK(stopped.took < Seconds(kEndLimit));
    CHECK_FALSE(stopped.left_behind);
    if (stopped.run.ending.signal == signal) {
      CHECK(stopped.run.out.empty());  // before main(): nothing had been started
      CHECK(stopped.run.err.empty());
    } else {
      CHECK(stopped.run.exit_code() == 0);
    }
  }
}

TEST_CASE("a signal stops the robot: the hardware is closed when the program ends", "[system][signals]") {
  const TempFolder folder;
  const Stopped stopped =
      stop_after(2.0 * (kSanitized ? 4.0 : 1.0), SIGINT, {"--trace", folder.file("trace")});
  check_stopped(stopped);
  const TraceFile trace(folder.file("trace"));
  REQUIRE(trace.has("state", {"scout", "Ready", "Active"}));
  CHECK(trace.state_before("scout") == "Closed");
  CHECK(trace.open_connections().empty());
  CHECK(trace.state_before("command") == "EXIT");
}

TEST_CASE("a signal ends a virtual run with 0 and its trace hash", "[system][signals]") {
  Subprocess program(deployer(
      Words{source_file("graphs/scout_goto.xml"), "--set", "goals=far: 16 6; near: 2 6"} + virtual_clock()));
  sleep_for(0.3);
  program.send(SIGTERM);
  const Run run = finish(program, Seconds(10));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.trace_hash());
}

TEST_CASE("a prompt that waits for the user does not keep the run from being stopped", "[system][signals]") {
  Subprocess program(deployer({source_file("graphs/scout_goto.xml"), "--set", "goals="}),
                     {.keep_input_open = true});
  REQUIRE(program.wait_for_output("goal (", Seconds(10) * kSlowdown));
  program.send(SIGINT);
  const Run run = finish(program, Seconds(3));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
}

TEST_CASE("a second signal ends a run that cannot end by itself within a second",
          "[system][signals][quiet]") {
  Subprocess program(deployer(greedy() + Words{"--until", "1000 s"}));
  REQUIRE(program.wait_for_output("counted", Seconds(10) * kSlowdown));
  program.send(SIGINT);
  // The kernel keeps one pending signal of a kind, so a second one at the same moment would not count.
  sleep_for(0.05);
  program.send(SIGINT);
  const auto sent = std::chrono::steady_clock::now();
  REQUIRE(program.wait(Seconds(10)));
  CHECK(std::chrono::steady_clock::now() - sent < std::chrono::seconds(1));
  CHECK_FALSE(program.group_lives());
}

TEST_CASE("two signals at once end a driving robot within a second, with 0", "[system][signals][quiet]") {
  Subprocess program(deployer({source_file("graphs/scout_goto.xml")}));
  sleep_for(1.0);
  program.send(SIGINT);
  program.send(SIGTERM);
  const auto sent = std::chrono::steady_clock::now();
  const Run run = finish(program, Seconds(10));
  CHECK(run.exit_code() == 0);
  CHECK(std::chrono::steady_clock::now() - sent < Seconds(kSanitized ? 5.0 : 1.0));
}

TEST_CASE(
    "a component that never ends its lap is named when the run is stopped, and the program ends within 3 s",
    "[system][signals]") {
  Subprocess program(deployer(greedy()));
  sleep_for(0.5);
  program.send(SIGINT);
  const auto sent = std::chrono::steady_clock::now();
  const Run run = finish(program, Seconds(10));
  INFO(run.err);
  CHECK(run.ended);
  CHECK(std::chrono::steady_clock::now() - sent < Seconds(kEndLimit));
  CHECK(run.says("greedy"));
}

TEST_CASE("SIGHUP and SIGQUIT stop the robot and end the run with 0, as SIGINT does", "[system][signals]") {
  stop_ignoring_terminal();
  for (const int signal : {SIGHUP, SIGQUIT}) {
    CAPTURE(signal);
    const TempFolder folder;
    const Run run = end_driving_robot(signal, folder.file("trace"));
    INFO(run.err);
    CHECK(run.ended);
    CHECK(run.exit_code() == 0);
    CHECK(run.err.empty());
    check_at_rest(folder.file("trace"));
  }
}

TEST_CASE("any other signal that ends a process stops the robot first; the run has failed, and says why",
          "[system][signals]") {
  struct Case {
    int signal;
    std::string name;
  };
  const std::vector<Case> cases{
      {SIGUSR1, "SIGUSR1"},     {SIGUSR2, "SIGUSR2"},     {SIGALRM, "SIGALRM"},
      {SIGVTALRM, "SIGVTALRM"}, {SIGPROF, "SIGPROF"},     {SIGXCPU, "SIGXCPU"},
      {SIGPWR, "SIGPWR"},       {SIGSTKFLT, "SIGSTKFLT"}, {SIGRTMIN + 1, "SIGRTMIN+1"}};
  const TempFolder folder;
  std::vector<std::future<Run>> runs;
  for (const Case& c : cases)
    runs.push_back(std::async(std::launch::async, [&c, &folder] {
      return end_driving_robot(c.signal, folder.file(c.name),
                               {"--name", "ended_by_" + std::to_string(c.signal)});
    }));
  auto next = runs.begin();
  for (const Case& c : cases) {
    CAPTURE(c.name);
    const Run run = (next++)->get();
    INFO(run.err);
    CHECK(run.ended);
    CHECK(run.exit_code() == 1);
    CHECK(run.says("the signal " + c.name + " ended the run"));
    check_at_rest(folder.file(c.name));
  }
}

TEST_CASE("SIGPIPE and SIGXFSZ change nothing", "[system][signals]") {
  for (const int signal : {SIGPIPE, SIGXFSZ}) {
    CAPTURE(signal);
    const TempFolder folder;
    const Run run = end_driving_robot(signal, folder.file("trace"), {"--until", "1.5 s", "--log", "warning"});
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.err.empty());
    CHECK(TraceFile(folder.file("trace")).lines().back().time > 1.4);
  }
}

TEST_CASE("a SIGHUP that the program was started to ignore, as by nohup, stays ignored",
          "[system][signals]") {
  Subprocess program(Words{"/bin/sh", "-c", "trap '' HUP; exec \"$@\"", "sh"} +
                     deployer({source_file("graphs/scout_goto.xml"), "--until", "1.5 s"}));
  sleep_for(0.8);
  program.send(SIGHUP);
  CHECK_FALSE(program.wait(Seconds(0.3)));
  CHECK(finish(program, Seconds(10)).exit_code() == 0);
}

TEST_CASE("a crash, an abort or an exit() of a component stops the robot before the process dies",
          "[system][signals]") {
  for (const char* deed : {"segfault", "abort", "noexcept", "exit"}) {
    CAPTURE(deed);
    const TempFolder folder;
    const Run run =
        run_deployer(Words{system_graph("crash_on_the_way.xml"), "--set", std::string("deed=") + deed,
                           "--trace", folder.file("trace"), "--in-process"} +
                     with_test_plugins());
    INFO(run.err);
    CHECK(run.ended);
    CHECK(run.exit_code() != 0);
    CHECK(run.says("bad: work()"));
    check_at_rest(folder.file("trace"));
  }
}
