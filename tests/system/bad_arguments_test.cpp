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
  check_refused({kGraph, "--trace", ""}, {"--trace", "a file"});
  check_refused({kGraph, "--name", ""}, {"--name", "a name"});
  check_refused({kGraph, "--machine", ""}, {"--machine", "a name"});
  check_refused({kGraph, "--picture", ".svg"}, {"--picture", "a file"});
  check_refused({kGraph, "--record", ".csv=goto.ArrivedPush"}, {"--record", "FILE.csv=PORT"});
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
  check_refused({kGraph, "--set", "avoid.stop_distence=1 m", "--set", "scuot.realism=harsh"},
                {"command line: error G029: component \"avoid\"", "\"stop_distance\"",
                 "command line: error G014: --set scuot.realism", "\"scout\""});
  if (kRefusedByComponent == 2)
    check_refused({kGraph, "--set", "command.goals=kitchen 3 4"},
                  {"command line: error G062: component \"command\""});
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

TEST_CASE(
    "everything that is wrong with a command line is reported at once, with what is wrong with the graph",
    "[system][bad]") {
  const Run run =
      run_deployer({kGraph, "--check", "--set", "a", "--clock", "lunar", "--seed", "many", "--stict",
                    "--until", "1 parsec", "--set", "gaols=a: 1 1", "--set", "world=lost.xml"});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  const std::string world = "scout_goto.xml:" + line_of(kGraph, "<param name=\"world\"") +
                            ":34: error G042: hardware \"scout\": parameter \"world\"";
  for (const char* hint :
       {"command line: error G014: --set a has no value", "command line: error C002: --clock expects",
        "command line: error C002: --seed expects", "command line: error C001: unknown option \"--stict\"",
        "command line: error C002: --until", "command line: error G014: --set gaols", world.c_str()}) {
    CAPTURE(hint);
    CHECK(run.says(hint));
  }
  CHECK(split_lines(run.err).size() == 7);
}

TEST_CASE("an option given twice does not win silently", "[system][bad]") {
  check_refused({kGraph, "--until", "1s", "--until", "2s"},
                {"C003: --until is given twice, as \"1s\" and \"2s\""});
  check_refused({kGraph, "--seed", "1", "--seed", "1"}, {"C003: --seed"});
  check_refused({kGraph, "--set", "realism=ideal", "--set", "realism=harsh"},
                {"G014: --set realism is given twice, as \"ideal\" and \"harsh\""});
  CHECK(run_deployer({kGraph, "--check", "--strict", "--strict", "--profile", "sim"}).exit_code() == 0);
}

TEST_CASE("one slip on the command line is one error", "[system][bad]") {
  for (const Words& words :
       {Words{"--clok", "virtual", kGraph}, Words{kGraph, "--rate", "3"}, Words{kGraph, "--clock", "lunar"},
        Words{kGraph, "--clock", "vitual", "--executor", "thread"}, Words{kGraph, "--set", "goals"},
        Words{kGraph, "--check", "--dot"}}) {
    const Run run = run_deployer(words);
    CAPTURE(words);
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(split_lines(run.err).size() == 1);
  }
}

TEST_CASE("control characters of the command line reach no terminal", "[system][bad]") {
  const Run run = run_deployer({"a\x1b[2J\nb.xml", "--check", "--set", "x\r=1", "--\x1b]0;title\x07"});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  for (const char c : {'\x1b', '\r', '\x07'}) CHECK(run.err.find(c) == std::string::npos);
  CHECK(run.says("a\\x1b[2J\\nb.xml"));
  const Run started = run_deployer(Words{kGraph, "--set", "goals=a\x1b[2J 3 4"} + virtual_clock());
  INFO(started.err);
  CHECK(started.exit_code() != 0);
  CHECK(started.err.find('\x1b') == std::string::npos);
  CHECK(started.says("a\\x1b[2J 3 4"));
}

TEST_CASE("with --json the errors of the command line are among those of the graph", "[system][bad]") {
  const Run run = run_deployer({kGraph, "--check", "--json", "--seed", "many"});
  CHECK(run.exit_code() == 2);
  CHECK(run.err.empty());
  CHECK(run.out.find("\"C002\"") != std::string::npos);
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
  CHECK(run_deployer({"--man"}).out.starts_with(".TH DEPLOYER 1"));
  CHECK(run_deployer({"--completion", "bash"}).out.find("--clock) _deployer_add steady virtual") !=
        std::string::npos);
}

TEST_CASE("the table of commands is also help, completion and man page", "[system][orcactl]") {
  const Run help = run_orcactl({"--help"});
  CHECK(help.exit_code() == 0);
  const Run man = run_orcactl({"--man"});
  const Run bash = run_orcactl({"--completion", "bash"});
  const Run zsh = run_orcactl({"--completion", "zsh"});
  for (const char* const command : {"ps", "echo", "estop", "alarms", "missions"})
    for (const Run* const run : {&help, &man, &bash, &zsh}) CHECK_THAT(run->out, Catch::Contains(command));
  CHECK(run_orcactl({"--completion", "fish"}).exit_code() == 2);
}
