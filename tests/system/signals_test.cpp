// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C at any moment stops the robot, leaves nothing behind and exits 0 within 3 s.
#include <signal.h>

#include <catch2/catch.hpp>
#include <cmath>
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

Words greedy() { return Words{system_graph("hog.xml"), "--set", "how=one_lap"} + with_test_plugins(); }

}  // namespace

TEST_CASE(
    "at ten instants of the first three seconds SIGINT and SIGTERM end the run with 0 within 3 s, and no "
    "process is left",
    "[system][signals]") {
  constexpr unsigned kSeed = 20040611;
  std::mt19937 random(kSeed);
  for (int i = 0; i < 10; ++i) {
    const double instant = 3.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    CAPTURE(kSeed, i, instant);
    check_stopped(stop_after(std::max(0.2, instant), i % 2 == 0 ? SIGINT : SIGTERM));
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

TEST_CASE("a second signal ends a run that cannot end by itself within a second", "[system][signals]") {
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

TEST_CASE("two signals at once end a driving robot within a second, with 0", "[system][signals]") {
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
