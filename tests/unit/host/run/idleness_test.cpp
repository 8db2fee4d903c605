// SPDX-License-Identifier: GPL-3.0-or-later
// A run in which nothing happens says so at its end, and why.
#include <catch2/catch.hpp>

#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Lines = std::vector<std::string>;

namespace {

std::string silent_life(const std::string& name, const std::string& attributes = "") {
  return "<component name=\"" + name + R"(" type="test.Life" )" + attributes + "/>";
}

std::string user_between(const std::string& from, const std::string& until,
                         const std::string& name = "user") {
  return "<component name=\"" + name + R"(" type="test.User"><param name="from" value=")" + from +
         R"("/><param name="until" value=")" + until + R"("/></component>)";
}

const std::string kListens = R"(<connect from="life.out" to="user.push"/>)";

Lines warnings_of(const std::string& elements, Duration until = 5s, const std::string& attributes = "") {
  RunOptions options = virtual_run();
  options.until = until;
  return record_run(attributes, elements, options).warnings;
}

}  // namespace

TEST_CASE("a component that nobody used says at the end of the run that it has never worked",
          "[host][idleness]") {
  CHECK(warnings_of(silent_life("life")) ==
        Lines{"life: has never worked in this run: nobody listens to it, and it works by itself only with "
              "autonomous=\"true\" in the graph"});
  CHECK(warnings_of(silent_life("life", "autonomous=\"true\"")).empty());
}

TEST_CASE("a component to which nobody subscribed names those that could have", "[host][idleness]") {
  CHECK(
      warnings_of(silent_life("life") + user_between("9", "10") + kListens) ==
      Lines{"life: has never worked in this run: none of those that it is connected to has subscribed: user",
            "orca: no connection has carried anything in this run"});
  CHECK(warnings_of(silent_life("life") + user_between("1", "2") + kListens).empty());
}

TEST_CASE("a component that only serves others, or is loaded on demand, may have had nothing to do",
          "[host][idleness]") {
  const std::string serves =
      silent_life("life") + user_between("9", "10") + R"(<connect from="user.send" to="life.poke"/>)";
  CHECK(warnings_of(serves) == Lines{"orca: no connection has carried anything in this run"});
  CHECK(warnings_of(silent_life("life", "start=\"on_demand\"")).empty());
}

TEST_CASE("a component that was only asked has done something", "[host][idleness]") {
  CHECK(warnings_of(silent_life("life") + user_between("1", "2") + kListens +
                    R"(<connect from="user.query" to="life.ask"/>)")
            .empty());
}

TEST_CASE("a component that was asked has done something, and that counts for no other one",
          "[host][idleness]") {
  const std::string asked = silent_life("life") + user_between("9", "10") + kListens +
                            R"(<connect from="asker.query" to="life.ask"/>)";
  CHECK(warnings_of(asked + user_between("1", "2", "asker")).empty());
  CHECK(warnings_of(asked + user_between("1", "2", "asker") + silent_life("other") +
                    user_between("9", "10", "second") + R"(<connect from="other.out" to="second.push"/>)") ==
        Lines{"other: has never worked in this run: none of those that it is connected to has subscribed: "
              "second"});
  CHECK(warnings_of(asked + user_between("9", "10", "asker")).size() == 2);  // it was never asked
}

TEST_CASE("a run that was too short for everybody to begin says nothing", "[host][idleness]") {
  CHECK(warnings_of(silent_life("life"), 900ms).empty());
}

TEST_CASE("a system that stands still from the start says why, however short it lasted", "[host][idleness]") {
  const RecordedRun run = record_run("", silent_life("life"), virtual_run());
  CHECK(run.result.outcome == RunOutcome::failed);
  CHECK(run.warnings.size() == 1);
}

TEST_CASE("a component that failed has said so already", "[host][idleness]") {
  const std::string failing = R"(<component name="life" type="test.Life" autonomous="true">
      <param name="mode" value="start fails"/></component>)";
  CHECK(warnings_of(failing).empty());
}

TEST_CASE("the graph's word on autonomous counts before the component's own", "[host][idleness]") {
  const std::string quiet =
      R"(<component name="user" type="test.User" autonomous="false"/>)" + silent_life("life") + kListens;
  CHECK(warnings_of(quiet).size() == 3);  // a User stays active by itself
}
