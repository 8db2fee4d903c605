// SPDX-License-Identifier: GPL-3.0-or-later
// A wrong command line: exit 2, nothing is started, nothing on stdout, and the error says what would be right.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

const std::string kGraph = source_file("graphs/scout_goto.xml");

void check_refused(const Words& words, const std::vector<std::string>& hints) {
  const Run run = run_deployer(words);
  CAPTURE(words);
  INFO(run.err);
  CHECK(run.ended);
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  for (const std::string& hint : hints) {
    CAPTURE(hint);
    CHECK(run.says(hint));
  }
}

}  // namespace

TEST_CASE("without a graph the deployer says what it needs", "[system][bad]") {
  check_refused({}, {"graph"});
  check_refused({"--check"}, {"graph"});
  check_refused({kGraph, kGraph}, {"one file"});
}

TEST_CASE("an unknown option is answered with the nearest one", "[system][bad]") {
  check_refused({kGraph, "--clok", "virtual"}, {"--clok", "--clock"});
  check_refused({kGraph, "--chek"}, {"--chek", "--check"});
}

TEST_CASE("an option without its value, or with a wrong one, says what it expects", "[system][bad]") {
  check_refused({kGraph, "--seed"}, {"--seed", "value"});
  check_refused({kGraph, "--seed", "many"}, {"--seed", "many", "integer"});
  check_refused({kGraph, "--seed", "-1"}, {"--seed", "-1"});
  check_refused({kGraph, "--clock", "lunar"}, {"steady", "virtual", "lunar"});
  check_refused({kGraph, "--executor", "thraed"}, {"thread", "fiber", "baton", "thraed"});
  check_refused({kGraph, "--until", "5 parsec"}, {"--until", "parsec"});
  check_refused({kGraph, "--until", "-5 s"}, {"--until", "-5"});
  check_refused({kGraph, "--log", "lots"}, {"--log", "lots", "warning"});
  check_refused({kGraph, "--picture", "run.gif"}, {"--picture", ".svg", ".png", "run.gif"});
}

TEST_CASE("the virtual clock does not run with a thread per component", "[system][bad]") {
  check_refused({kGraph, "--clock", "virtual", "--executor", "thread"},
                {"virtual", "thread", "fiber", "baton"});
}

TEST_CASE("an argument that the graph does not have, or that has no value, is refused with the nearest one",
          "[system][bad]") {
  check_refused({kGraph, "--set", "gaols=a: 1 1"}, {"gaols", "\"goals\""});
  check_refused({kGraph, "--set", "goals"}, {"ARG=VALUE", "goals"});
  check_refused({kGraph, "--profile", "simm"}, {"simm", "\"sim\""});
}

TEST_CASE("goals that cannot be read are refused with what a goal looks like, and nothing drives",
          "[system][bad]") {
  for (const char* goals : {"kitchen 3 4", "kitchen: 3", "kitchen: 3 x", "1st: 3 4"}) {
    const Run run = run_deployer(Words{kGraph, "--set", std::string("goals=") + goals} + virtual_clock());
    CAPTURE(goals);
    INFO(run.err);
    CHECK((run.exit_code() == 2 || run.exit_code() == 3));
    CHECK(run.arrivals().empty());
    CHECK(run.says("a goal looks like"));
    CHECK(run.says("command"));
  }
}

TEST_CASE("a trace or picture that cannot be written is reported with the reason", "[system][bad]") {
  const TempFolder folder;
  const Run run = run_deployer(
      Words{kGraph, "--until", "1s", "--trace", folder.file("no/such/folder/trace")} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 3);
  CHECK(run.says("no/such/folder/trace"));
  CHECK(run.says("No such file"));
}

TEST_CASE("--check says that a good graph is good, starts nothing, and exits with 0", "[system]") {
  const Run run = run_deployer({kGraph, "--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.out.empty());
}

TEST_CASE("--print gives the graph after arguments and profiles, and that is a graph again", "[system]") {
  const TempFolder folder;
  const Run printed = run_deployer({kGraph, "--print"});
  INFO(printed.err);
  CHECK(printed.exit_code() == 0);
  CHECK(printed.out.find("${") == std::string::npos);
  const Run again = run_deployer({folder.write("printed.xml", printed.out), "--print"});
  INFO(again.err);
  CHECK(again.exit_code() == 0);
  CHECK(again.out == printed.out);
}

TEST_CASE("a printed graph runs to the same trace hash as the graph itself", "[system]") {
  const TempFolder folder;
  const std::string printed = folder.write("printed.xml", run_deployer({kGraph, "--print"}).out);
  const Words options = Words{"--until", "10s"} + virtual_clock();
  const auto hash = run_deployer(Words{kGraph} + options).trace_hash();
  REQUIRE(hash);
  CHECK(run_deployer(Words{printed} + options).trace_hash() == hash);
}

TEST_CASE("--help and --version answer on stdout", "[system]") {
  const Run help = run_deployer({"--help"});
  CHECK(help.exit_code() == 0);
  CHECK(help.out.find("--clock") != std::string::npos);
  CHECK(help.err.empty());
  CHECK(run_deployer({"--version"}).out.find("orca") != std::string::npos);
}
