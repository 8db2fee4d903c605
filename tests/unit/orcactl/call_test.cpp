// SPDX-License-Identifier: GPL-3.0-or-later
#include "call.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::orcactl;
using Catch::Contains;

namespace {

std::string error_of(const std::vector<std::string>& words) {
  const Result<Call> call = parse_call(words);
  REQUIRE_FALSE(call);
  CHECK(call.error().code == Code::invalid_argument);
  return call.error().message;
}

}  // namespace

TEST_CASE("a command has its words and options wherever they stand", "[orcactl]") {
  const Result<Call> call =
      parse_call({"--json", "log", "--follow", "goto", "--system", "scout", "--level", "error"});
  REQUIRE(call);
  CHECK(call->command->name == "log");
  CHECK(call->words == std::vector<std::string>{"goto"});
  CHECK(call->system == "scout");
  CHECK(call->json);
  CHECK(call->has("--follow"));
  CHECK(call->options.find("--level")->second == "error");
}

TEST_CASE("of an option that is given twice the last one counts, unless each does", "[orcactl]") {
  CHECK(parse_call({"echo", "a.b", "--count", "3", "--count", "4"})->count("--count") == 4);
  const Result<Call> call = parse_call({"swap", "a", "b.so", "--set", "p=1", "--set", "q=2"});
  REQUIRE(call);
  CHECK(call->options.count("--set") == 2);
}

TEST_CASE("spans of time and counts are read with their units", "[orcactl]") {
  CHECK(parse_call({"hz", "a.b", "--for", "500 ms"})->duration("--for") == Duration(500ms));
  CHECK(parse_call({"echo", "a.b", "--count", "3"})->count("--count") == 3);
  CHECK_FALSE(parse_call({"echo", "a.b"})->count("--count"));
  CHECK_THAT(error_of({"hz", "a.b", "--for", "5 kg"}), Contains("--for"));
  CHECK_THAT(error_of({"echo", "a.b", "--count", "0"}), Contains("above 0"));
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
  CHECK_THAT(error_of({"diff", ""}), Contains("\"\" names no file"));
  CHECK_THAT(error_of({"swap", "avoid", ""}), Contains("\"\" names no file"));
  CHECK_THAT(error_of({"swap", "avoid", "x.so:"}),
             Contains("leave out the colon, or write the type after it"));
}

TEST_CASE("set takes any number of parameters, each with its value", "[orcactl]") {
  CHECK(parse_call({"set", "a.x", "-0.3 m", "b.y", "true"})->words.size() == 4);
  CHECK_THAT(error_of({"set", "a.x"}), Contains("set needs VALUE"));
  CHECK_THAT(error_of({"set", "a.x", "1", "b.y"}), Contains("set needs a value after \"b.y\""));
}

TEST_CASE("help is there without a command, and for one without its arguments", "[orcactl]") {
  CHECK(parse_call({"--help"})->help);
  CHECK(parse_call({"-h"})->command == nullptr);
  CHECK(parse_call({"echo", "--help"})->command->name == "echo");
}
