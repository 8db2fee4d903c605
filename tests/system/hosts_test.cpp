// SPDX-License-Identifier: GPL-3.0-or-later
// In real time every graph runs in host processes, and looks to its user as it does in one process.
#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <functional>
#include <sstream>
#include <thread>

#include "deployer.hpp"
#include "process_table.hpp"
#include "temp_folder.hpp"
#include "terminal.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

const std::string kScout = source_file("graphs/scout_goto.xml");
const std::string kThree = source_file("graphs/scout_goto_processes.xml");
constexpr Seconds kLimit{10.0 * kSlowdown};

bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  while (!condition() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return condition();
}

// Waits for a host process, another than one that is lost.
pid_t host_process(const Subprocess& program, const std::string& name, pid_t lost = 0) {
  pid_t found = 0;
  const auto is_there = [&] {
    const auto children = children_of(program.pid());
    const auto child = children.find(name);
    found = child == children.end() ? 0 : child->second;
    return found != 0 && found != lost;
  };
  REQUIRE(comes_true(is_there));
  return found;
}

bool says_after(const Subprocess& program, std::size_t mark, const std::string& text) {
  const bool said = comes_true([&] { return program.err().find(text, mark) != std::string::npos; });
  INFO(program.err());
  INFO(text);
  CHECK(said);
  return said;
}

void check_stops_well(Subprocess& program) {
  program.send(SIGTERM);
  const Run run = finish(program, Seconds(5));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(living_in_group(program.pid()).empty());
}

std::size_t rows_of(const std::string& table) { return split_lines(read_text(table)).size(); }

}  // namespace

TEST_CASE("a graph that declares no process runs in one below the deployer", "[system][hosts]") {
  Subprocess program(deployer({kScout}));
  const pid_t host = host_process(program, "main");
  CHECK(children_of(program.pid()).size() == 1);
  REQUIRE(comes_true([&] { return threads_of(host) > 5; }));  // its components
  CHECK(threads_of(program.pid()) <= 3);
  check_stops_well(program);
}

TEST_CASE("for a debugger everything runs in the deployer", "[system][hosts]") {
  Subprocess program(deployer({kScout, "--in-process", "--until", "1 s"}));
  while (!program.wait(Seconds(0.05))) CHECK_FALSE(children_of(program.pid()).contains("main"));
  CHECK(finish(program, Seconds(5)).exit_code() == 0);
}

// The sanitizers take the signal of the crash.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST_CASE("a crash of a plugin is not the end of the deployer, whatever the graph declares",
          "[system][hosts]") {
  Subprocess program(
      deployer(Words{system_graph("crash_on_the_way.xml"), "--set", "deed=segfault"} + with_test_plugins()));
  const pid_t host = host_process(program, "main");
  says_after(program, 0, "alarm PROCESS_ENDED: process main was ended by SIGSEGV");
  says_after(program, 0, "process main is back");
  CHECK_FALSE(is_alive(host));
  check_stops_well(program);
  CHECK_THAT(program.err(), Contains("bad: work() ended the process with the signal SIGSEGV"));
}

#endif

TEST_CASE("a host process writes trace, recordings and picture, and tells what its connections carried",
          "[system][hosts]") {
  const TempFolder folder;
  const Run run = run_deployer({kScout, "--until", "2 s", "--trace", folder.file("trace"), "--record",
                                folder.file("poses.csv") + "=localizer.RobotPosePush", "--picture",
                                folder.file("run.svg"), "--stats", "--progress"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(read_text(folder.file("trace")), Contains(" deliver goto localizer "));
  CHECK(rows_of(folder.file("poses.csv")) > 10);
  CHECK_THAT(read_text(folder.file("run.svg")), Contains("<svg"));
  CHECK_THAT(run.err,
             Contains("localizer.RobotPosePush -> goto.localizer ") && Contains("base has driven 0."));
}

TEST_CASE("of several processes each writes what it has, and all count", "[system][hosts]") {
  const TempFolder folder;
  const Run run = run_deployer({kThree, "--until", "2 s", "--record",
                                folder.file("poses.csv") + "=localizer.RobotPosePush", "--record",
                                folder.file("wishes.csv") + "=goto.MotionCmdPush,avoid.motion", "--picture",
                                folder.file("run.svg"), "--stats"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(rows_of(folder.file("poses.csv")) > 10);
  CHECK(rows_of(folder.file("wishes.csv")) > 10);
  CHECK_THAT(read_text(folder.file("run.svg")), Contains("<svg"));
  std::istringstream row(run.err.substr(run.err.find("localizer.RobotPosePush -> goto.localizer ")));
  std::string from, arrow, to;
  long delivered = 0;
  REQUIRE(row >> from >> arrow >> to >> delivered);
  CHECK(delivered > 10);
}

TEST_CASE("what no single process can write is refused before anything starts, with the reason",
          "[system][hosts]") {
  const Run traced = run_deployer({kThree, "--trace", "trace.txt"});
  CHECK(traced.exit_code() == 2);
  CHECK_THAT(traced.err, Contains("C004") && Contains("several processes have no order in common"));
  const Run recorded = run_deployer({kThree, "--record", "a.csv=localizer.RobotPosePush,goto.PathPush"});
  CHECK(recorded.exit_code() == 2);
  CHECK_THAT(recorded.err,
             Contains("--record a.csv") && Contains("base, behaviours; give each a file of its own"));
  const Run baton = run_deployer({kThree, "--executor", "baton"});
  CHECK(baton.exit_code() == 2);
  CHECK_THAT(baton.err, Contains("--executor baton runs one strand at a time"));
  CHECK_FALSE(fs::exists("trace.txt"));
  CHECK_FALSE(fs::exists("a.csv"));
}

TEST_CASE("a process that is started again does not overwrite what was written before", "[system][hosts]") {
  const TempFolder folder;
  const std::string table = folder.file("poses.csv");
  Subprocess program(deployer(Words{system_graph("crash_on_the_way.xml"), "--set", "deed=segfault",
                                    "--record", table + "=localizer.RobotPosePush"} +
                              with_test_plugins()));
  says_after(program, 0, "main: is started again; its trace, recordings or picture end where it was lost");
  says_after(program, 0, "process main is back");
  check_stops_well(program);
  CHECK(rows_of(table) > 3);  // written before it crashed
}

TEST_CASE("the terminal is usable again after the loss of the process that reads its keys",
          "[system][hosts]") {
  const Terminal terminal;
  Subprocess program(deployer(Words{system_graph("teleop.xml"), "--set", "keyboard=" + terminal.name()} +
                              with_test_plugins()));
  REQUIRE(terminal.comes_to_echo(false));
  const pid_t host = host_process(program, "main");
  REQUIRE(kill(host, SIGKILL) == 0);
  says_after(program, 0, "process main is back");
  REQUIRE(terminal.comes_to_echo(false));
  terminal.press("w");
  CHECK(program.wait_for_output("FUSED by teleop speed 0.30", kLimit));
  check_stops_well(program);
  CHECK(terminal.comes_to_echo(true));
}

TEST_CASE("keys that come by stdin reach the process that reads them", "[system][hosts]") {
  Subprocess program(
      deployer(Words{system_graph("teleop.xml"), "--set", "keyboard=stdin"} + with_test_plugins()),
      {.keep_input_open = true});
  REQUIRE(program.wait_for_output("TOLD_TO_STOP by teleop", kLimit));
  program.write_input("w");
  CHECK(program.wait_for_output("FUSED by teleop speed 0.30", kLimit));
  program.write_input("q");
  CHECK(finish(program, kLimit).exit_code() == 0);
}

TEST_CASE("a question to the user stands as it is on stderr, also if the answer is there already",
          "[system][hosts]") {
  Subprocess program(deployer({kScout, "--set", "goals=", "--until", "3 s"}), {.input = "near: 3.6 6\n"});
  const Run run = finish(program, kLimit);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.err, Contains("goal (name: x y > x y, empty line to end)? ") && !Contains("main: goal ("));
}

TEST_CASE("alarms of all processes and of the supervisor reach AlarmCentral", "[system][hosts][alarms]") {
  Subprocess program(deployer(Words{system_graph("alarms.xml")} + with_test_plugins()));
  says_after(program, 0, " FAILED of hooligan: ");
  const std::size_t mark = program.err().size();
  REQUIRE(kill(host_process(program, "bad"), SIGKILL) == 0);
  says_after(program, mark, " PROCESS_ENDED of : process bad was ended by SIGKILL");
  check_stops_well(program);
}

TEST_CASE("alarms stay although their source and AlarmCentral are started again", "[system][hosts][alarms]") {
  Subprocess program(deployer(Words{system_graph("alarms.xml")} + with_test_plugins()));
  says_after(program, 0, " FAILED of hooligan: ");
  const pid_t bad = host_process(program, "bad");
  REQUIRE(kill(bad, SIGKILL) == 0);
  says_after(program, 0, "process bad is back");
  const std::size_t mark = program.err().size();
  REQUIRE(kill(host_process(program, "central"), SIGKILL) == 0);
  says_after(program, mark, "process central is back");
  for (const std::string alarm : {" FAILED of hooligan: ", " PROCESS_ENDED of : process bad ",
                                  " PROCESS_ENDED of : process central "}) {
    says_after(program, mark, "listener: hears ");
    const auto heard = [&] {
      const auto lines = split_lines(program.err().substr(mark));
      return std::ranges::any_of(lines, [&](const std::string& line) {
        return line.find("listener: hears ") != std::string::npos && line.find(alarm) != std::string::npos;
      });
    };
    CAPTURE(alarm);
    CHECK(comes_true(heard));
  }
  INFO(program.err());
  check_stops_well(program);
}

TEST_CASE("in one process AlarmCentral has the alarms of that process", "[system][hosts][alarms]") {
  const Run run =
      run_deployer(Words{system_graph("alarms.xml"), "--in-process", "--until", "1 s"} + with_test_plugins());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.err, Contains("listener: hears ") && Contains(" FAILED of hooligan: "));
}

// To load these two took half of the time of a start (docs/adr/0092-fcl-measures-what-decides.md).
TEST_CASE("FCL and cairo are loaded only where they are used", "[system][hosts]") {
  const TempFolder folder;
  const auto libraries_of = [&](const std::string& graph, const Words& more) {
    Subprocess run(
        Words{"/usr/bin/env", "LD_DEBUG=files"} +
        deployer(Words{source_file("graphs/" + graph), "--until", "0.1s"} + more + virtual_clock()));
    const Run ended = finish(run, Seconds(60));
    CHECK(ended.exit_code() == 0);
    return ended.err;
  };
  const std::string plain = libraries_of("scout_goto.xml", {});
  CHECK_THAT(plain, Contains("calling init: ") && Contains("/sim.so"));
  CHECK_THAT(plain, !Contains("libfcl") && !Contains("libcairo"));
  CHECK_THAT(libraries_of("scout_goto.xml", {"--picture", (folder.path() / "way.svg").string()}),
             Contains("libcairo"));
  CHECK_THAT(libraries_of("pioneer_tasks.xml", {}), Contains("libfcl"));  // its gate asks FCL
}
