// SPDX-License-Identifier: GPL-3.0-or-later
// What it means for a drive that computing takes time, and how that is measured.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

Run drive(const Words& more) {
  const Run run = run_deployer(
      Words{source_file("graphs/pioneer_planner.xml"), "--until", "20 s", "--stats"} + virtual_clock() + more,
      Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  REQUIRE(run.trace_hash());
  return run;
}

}  // namespace

TEST_CASE("a planner that takes time drives another way, the same one each time", "[system][computing]") {
  const Run free = drive({});
  const Run slow = drive({"--set", "takes=60 ms"});
  CHECK(slow.trace_hash() != free.trace_hash());
  CHECK_THAT(slow.err, Contains("computes") && Contains("planner"));
  CHECK_THAT(free.err, !Contains("computes"));
  CHECK(drive({"--set", "takes=60 ms", "--executor", "baton"}).trace_hash() == slow.trace_hash());
  CHECK(drive({"--set", "takes=6 ms", "--computing", "10"}).trace_hash() == slow.trace_hash());
  CHECK(drive({"--set", "takes=60 ms", "--computing", "0"}).trace_hash() == free.trace_hash());
}

TEST_CASE("what laps took on this machine is written to a file, from which a graph draws",
          "[system][computing]") {
  const TempFolder folder;
  const std::string file = folder.file("laps.xml");
  const Run measured = drive({"--measure-laps", file});
  CHECK(measured.trace_hash() == drive({}).trace_hash());
  const std::string text = read_text(file);
  CHECK_THAT(text, Contains("<laps graph=\"pioneer_planner\" processor=\"") &&
                       Contains("<component name=\"planner\" type=\"orca.GridPlanner\" laps=\""));
  const Words by_file{"--set", "takes=" + file, "--computing", "50"};
  const Run drawn = drive(by_file);
  CHECK(drawn.trace_hash() == drive(by_file + Words{"--executor", "baton"}).trace_hash());
  CHECK(drawn.trace_hash() != measured.trace_hash());
}

TEST_CASE("laps of a process with one core wait for each other", "[system][computing]") {
  const auto drive_on_one_core = [](const std::string& factor) {
    const Run run = run_deployer(Words{source_file("graphs/pioneer_one_core.xml"), "--until", "10 s",
                                       "--stats", "--computing", factor} +
                                     virtual_clock(),
                                 Seconds(60));
    INFO(run.err);
    REQUIRE(run.exit_code() == 0);
    REQUIRE(run.trace_hash());
    return run;
  };
  const Run slow = drive_on_one_core("500");
  CHECK_THAT(slow.err, Contains("computes") && Contains("waited [s]"));
  CHECK(slow.trace_hash() == drive_on_one_core("500").trace_hash());
  CHECK(slow.trace_hash() != drive_on_one_core("0").trace_hash());
}

TEST_CASE("the time of laps needs virtual time, and its measurement a run in one process",
          "[system][computing]") {
  const std::string graph = source_file("graphs/pioneer_planner.xml");
  const Run factor = run_deployer({graph, "--computing", "10"});
  CHECK(factor.exit_code() == 2);
  CHECK_THAT(factor.err, Contains("--computing goes with --clock virtual"));
  const Run measure = run_deployer({graph, "--measure-laps", "/nowhere/laps.xml"});
  CHECK(measure.exit_code() == 2);
  CHECK_THAT(measure.err, Contains("--measure-laps needs --clock virtual or --in-process"));
  const Run file = run_deployer(Words{graph, "--measure-laps", "/nowhere/laps.xml"} + virtual_clock());
  CHECK(file.exit_code() == 2);
  CHECK_THAT(file.err, Contains("/nowhere/laps.xml"));
  CHECK_THAT(run_deployer(Words{graph, "--computing", "-1"} + virtual_clock()).err,
             Contains("--computing: "));
}
