// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::orcactl;
using Catch::Contains;

namespace {

apps::Call parsed(const std::vector<std::string>& words) { return apps::parse(program(), words); }

apps::Call right(const std::vector<std::string>& words) {
  apps::Call call = parsed(words);
  for (const apps::Problem& problem : call.problems) FAIL(problem.message);
  return call;
}

std::string error_of(const std::vector<std::string>& words) {
  const apps::Call call = parsed(words);
  REQUIRE(call.problems.size() == 1);
  return call.problems.front().message;
}

}  // namespace

TEST_CASE("a command has its words and options wherever they stand", "[orcactl]") {
  const apps::Call call =
      right({"--json", "log", "--follow", "goto", "--system", "scout", "--level", "error"});
  CHECK(call.command->name == "log");
  CHECK(call.words == std::vector<std::string>{"goto"});
  CHECK(call.text("--system") == "scout");
  CHECK(call.has("--json"));
  CHECK(call.has("--follow"));
  CHECK(call.text("--level") == "error");
}

TEST_CASE("an option with a value is given once, unless it repeats", "[orcactl]") {
  CHECK_THAT(error_of({"echo", "a.b", "--count", "3", "--count", "4"}),
             Contains("--count is given twice, as \"3\" and \"4\""));
  CHECK(right({"swap", "a", "b.so", "--set", "p=1", "--set", "q=2"}).all("--set") ==
        std::vector<std::string>{"p=1", "q=2"});
  CHECK(right({"ps", "--json", "--json"}).has("--json"));
}

TEST_CASE("spans of time and counts are read with their units", "[orcactl]") {
  CHECK(right({"hz", "a.b", "--for", "500 ms"}).duration("--for") == Duration(500ms));
  CHECK(right({"echo", "a.b", "--count", "3"}).count("--count") == 3);
  CHECK_FALSE(right({"echo", "a.b"}).count("--count"));
  CHECK_THAT(error_of({"hz", "a.b", "--for", "5 kg"}), Contains("--for"));
  CHECK_THAT(error_of({"echo", "a.b", "--count", "0"}), Contains("an integer from 1 on"));
}

TEST_CASE("a wrong command line says what would be right", "[orcactl]") {
  CHECK_THAT(error_of({}), Contains("which command"));
  CHECK_THAT(error_of({"ehco", "a.b"}), Contains("did you mean \"echo\"?"));
  CHECK_THAT(error_of({"log", "--folow"}), Contains("did you mean \"--follow\"?"));
  CHECK_THAT(error_of({"ps", "--follow"}), Contains("unknown option \"--follow\" of ps"));
  CHECK_THAT(error_of({"echo"}), Contains("echo needs PORT"));
  CHECK_THAT(error_of({"suspend", "a", "b"}), Contains("\"b\""));
  CHECK_THAT(error_of({"stop", "--watch"}), Contains("does not go with --watch"));
  CHECK_THAT(error_of({"ps", "--system"}), Contains("expects a value"));
  CHECK_THAT(error_of({"log", "--level", "loud"}), Contains("debug, info, warning or error, not \"loud\""));
  CHECK_THAT(error_of({"diff", ""}), Contains("\"\" names no file"));
  CHECK_THAT(error_of({"swap", "avoid", ""}), Contains("\"\" names no file"));
  CHECK_THAT(error_of({"swap", "avoid", "x.so:"}),
             Contains("leave out the colon, or write the type after it"));
}

TEST_CASE("set takes any number of parameters, each with its value", "[orcactl]") {
  CHECK(right({"set", "a.x", "-0.3 m", "b.y", "true"}).words.size() == 4);
  CHECK_THAT(error_of({"set", "a.x"}), Contains("set needs VALUE"));
  CHECK_THAT(error_of({"set", "a.x", "1", "b.y"}), Contains("set needs a value after \"b.y\""));
}

TEST_CASE("all that is wrong with a command line is reported", "[orcactl]") {
  const apps::Call call = parsed({"echo", "--count", "0", "--jsno"});
  REQUIRE(call.problems.size() == 3);
  CHECK(call.is_wrong("--count"));
  CHECK(call.problems[0].kind == apps::Problem::Kind::value);
  CHECK(call.problems[1].kind == apps::Problem::Kind::unknown_option);
  CHECK(call.problems[2].kind == apps::Problem::Kind::words);
}

TEST_CASE("help is there without a command, and for one without its arguments", "[orcactl]") {
  CHECK(right({"--help"}).has("--help"));
  CHECK(right({"-h"}).command == nullptr);
  CHECK(right({"echo", "--help"}).command->name == "echo");
}
