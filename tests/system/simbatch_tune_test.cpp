// SPDX-License-Identifier: GPL-3.0-or-later
// The tuner: it finds what is known to be best, in worlds of its own, and says with which budget.
#include <catch2/catch.hpp>

#include <string>

#include "batches.hpp"
#include "orca/xml/number.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

constexpr const char* kTuningWorld = R"(<world name="far"><set arg="realism" value="ideal"/></world>)";

// A robot drives three metres along a free corridor: the faster the better.
std::string corridor(const TempFolder& folder, const std::string& tuning_world = kTuningWorld,
                     const std::string& more = "") {
  return folder.write("corridor.xml", R"(<experiment name="corridor" seeds="1" until="60 s" graph=")" +
                                          source_file("graphs/pioneer_laser_goto.xml") + R"(">
  <set arg="goals" value="end: 3.6 6"/>
  <goal x="3.6 m" y="6 m" radius="0.3 m"/>
  <variant name="slow">
    <set arg="goto.max_speed" value="0.1 m/s"/>
    <tune arg="goto.max_speed" from="0.1 m/s" to="0.4 m/s" scale="log"/>
  </variant>
  <variant name="as_it_is"/>)" + more + R"(
  <world name="near"><set arg="realism" value="nominal"/></world>
  <tuning draws="4" seed="3">)" + tuning_world +
                                          "</tuning></experiment>");
}

std::string tune(const std::string& experiment, const std::string& out, const Words& more = {}) {
  const Run run = run_simbatch(Words{"tune", experiment, "--out", out} + more);
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return run.out;
}

// The speed [m/s] of a line of draws.csv; that of the first draw is the declared one.
double speed_in(const std::string& line) {
  const std::size_t at = line.find("max_speed=");
  if (at == std::string::npos) return 0.1;
  return orca::xml::parse_leading_number(line.substr(at + 10))->value;
}

}  // namespace

TEST_CASE("the tuner takes the fastest of its draws where faster is better, and says its budget",
          "[system][batch]") {
  const TempFolder folder;
  const std::string said = tune(corridor(folder), folder.file("out"));
  const std::vector<std::string> draws = split_lines(text_in(folder.file("out") + "/draws.csv"));
  REQUIRE(draws.size() == 1 + 4);
  double fastest = 0.0;
  for (std::size_t i = 1; i < draws.size(); ++i) {
    CAPTURE(draws[i]);
    CHECK_THAT(draws[i], Contains(",1,1,"));  // one run, one success
    CHECK((speed_in(draws[i]) >= 0.1 && speed_in(draws[i]) <= 0.4));
    fastest = std::max(fastest, speed_in(draws[i]));
  }
  const std::string best = text_in(folder.file("out") + "/slow.xml");
  CHECK_THAT(best, Contains("arg=\"goto.max_speed\" value=\"" + orca::xml::number_text(fastest) + " m/s\""));
  CHECK_THAT(best, Contains("of 4 (seed 3)") && Contains("4 runs in 1 worlds"));
  CHECK_THAT(said, Contains("slow: draw") && !Contains("as_it_is"));
}

TEST_CASE("tuning gives the same bytes with one worker and with two, and goes on where it was",
          "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = corridor(folder);
  tune(experiment, folder.file("one"), {"--jobs", "1"});
  tune(experiment, folder.file("two"), {"--jobs", "2"});
  for (const char* file : {"/draws.csv", "/slow.xml"})
    CHECK(text_in(folder.file("one") + file) == text_in(folder.file("two") + file));
  CHECK(run_simbatch({"tune", experiment, "--out", folder.file("one")}).exit_code() == 2);
  tune(experiment, folder.file("one"), {"--resume"});
  CHECK(text_in(folder.file("one") + "/draws.csv") == text_in(folder.file("two") + "/draws.csv"));
}

TEST_CASE("a variant drives with the settings that the tuner wrote", "[system][batch]") {
  const TempFolder folder;
  folder.write("best.xml",
               "<settings version=\"1\"><set arg=\"goto.max_speed\" value=\"0.3 m/s\"/></settings>");
  const std::string experiment = corridor(
      folder, kTuningWorld,
      R"(<variant name="tuned" settings="best.xml"/><variant name="by_hand"><set arg="goto.max_speed" value="0.3 m/s"/></variant>)");
  const std::vector<std::string> runs = split_lines(batch(experiment, folder.file("out")));
  REQUIRE(runs.size() == 1 + 4);
  CHECK(runs[2].substr(runs[2].find(',')) == runs[4].substr(runs[4].find(',')));  // by_hand and tuned
  CHECK(runs[1].substr(runs[1].find(',')) != runs[4].substr(runs[4].find(',')));
}

TEST_CASE("errors of <tuning> and of the graphs are said at once, also those of the tuner's worlds",
          "[system][batch]") {
  const TempFolder folder;
  const std::string experiment =
      corridor(folder, R"(<world name="far"><set arg="realism" value="ideel"/></world>)",
               R"(<variant name="wrong"><tune arg="goto.max_speed" from="2" to="1"/></variant>)");
  for (const Words& words : {Words{experiment, "--check"}, {"tune", experiment}}) {
    const Run run = run_simbatch(words);
    CHECK(run.exit_code() == 2);
    CHECK_THAT(run.err, Contains("error E015: it must be above from") && Contains("\"ideel\" is not one of"));
  }
}

TEST_CASE("worlds that are compared in are refused for tuning", "[system][batch]") {
  const TempFolder folder;
  const Run same = run_simbatch(
      {"tune", corridor(folder, R"(<world name="again"><set arg="realism" value="nominal"/></world>)")});
  CHECK(same.exit_code() == 2);
  CHECK_THAT(same.err, Contains("error E015: world \"again\" of the tuner is \"near\" of the experiment"));
}
