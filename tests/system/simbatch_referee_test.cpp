// SPDX-License-Identifier: GPL-3.0-or-later
// The referee of a batch from outside: what a component claims of its goals is not what the run is worth.
#include <catch2/catch.hpp>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "batches.hpp"
#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

constexpr const char* kOfficeGoals = R"(
  <goal x="4.2 m" y="9.8 m" radius="0.3 m" hold="0.5 s"/>
  <goal x="9 m" y="2 m" radius="0.3 m" hold="0.5 s"/>
  <goal x="13 m" y="10.4 m" radius="0.3 m" hold="0.5 s"/>)";

// Runs in the office: an honest robot, one that says that it has arrived from anywhere near, and one that says so at once.
std::string liars(const TempFolder& folder, const std::string& goals) {
  return folder.write(
      "liars.xml",
      R"(<experiment name="liars" seeds="1-2" until="120 s" metrics="success spl barn_score" graph=")" +
          source_file("graphs/pioneer_laser_goto.xml") + "\">" + goals + R"(
  <variant name="honest"/>
  <variant name="vague"><set arg="command.reach_radius" value="9.9 m"/></variant>
  <variant name="at_once"><set arg="command.reach_radius" value="1000 m"/></variant>
  <world name="office" reference="45 m"/>
</experiment>)");
}

// The rows of a table by the names of its columns.
using Rows = std::vector<std::map<std::string, std::string>>;
Rows rows_of(const std::string& table) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> found;
    std::istringstream words(line);
    for (std::string cell; std::getline(words, cell, ',');) found.push_back(cell);
    return found;
  };
  const std::vector<std::string> lines = split_lines(table);
  const std::vector<std::string> names = cells(lines.at(0));
  Rows rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> values = cells(lines[i]);
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = k < values.size() ? values[k] : "";
  }
  return rows;
}

}  // namespace

TEST_CASE("a variant that claims success where it is not scores nothing, and is named", "[system][batch]") {
  const TempFolder folder;
  const Run run = run_simbatch({liars(folder, kOfficeGoals), "--out", folder.file("out")});
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("honest: 2 runs, 100.0 %"));
  CHECK_THAT(run.out, !Contains("honest claims"));
  for (const std::string liar : {"vague", "at_once"}) {
    CHECK_THAT(run.out, Contains(liar + ": 2 runs, 0.0 %"));
    CHECK_THAT(run.out, Contains("2 goal_failed; claims goals wrongly in 2 runs"));
  }
  for (const auto& row : rows_of(exported(folder.file("out")))) {
    INFO(row.at("variant"));
    const bool honest = row.at("variant") == "honest";
    CHECK(row.at("ending") == (honest ? "success" : "goal_failed"));
    CHECK(row.at("failure") == (honest ? "" : "lost"));
    CHECK(row.at("claimed") == "3");
    CHECK((row.at("claimed_wrongly") == "0") == honest);
    CHECK((std::stod(row.at("barn_score")) > 0.0) == honest);
    CHECK((std::stod(row.at("spl")) > 0.0) == honest);
  }
  CHECK_THAT(text_in(folder.file("out") + "/report.md"),
             Contains("| claims goals wrongly in 2 runs |") &&
                 Contains("the robot within 0.3 m of 4.2 9.8, for 0.5 s"));
}

TEST_CASE("a robot that gives up a goal that it has reached, while another is on its way, is no crash",
          "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = folder.write(
      "shy.xml", R"(<experiment name="shy" profile="sim odometry" seeds="1" until="60 s" graph=")" +
                     source_file("graphs/two_robots.xml") +
                     R"(">
  <goal robot="Dewey" x="9 m" y="4.5 m" radius="1 m"/>
  <goal robot="Huey" place="west" radius="1 m"/>
  <goal robot="Huey" place="east" radius="1 m"/>
  <variant name="shy"><set arg="dewey/command.reach_radius" value="1 cm"/><set arg="dewey/goto.blocked_after" value="5 s"/></variant>
  <world name="hall"/>
</experiment>)");
  batch(experiment, folder.file("out"));
  const auto row = rows_of(exported(folder.file("out"))).at(0);
  CHECK(row.at("ending") == "goal_failed");
  CHECK(row.at("failure") != "crash");
  CHECK(row.at("goals") == "2");  // the goal of the one that gave up, and the first of the other
  CHECK(row.at("claimed") == "0");
}

TEST_CASE("without goals the components' own word counts, and the report says so", "[system][batch]") {
  const TempFolder folder;
  const Run run = run_simbatch({liars(folder, ""), "--out", folder.file("out")});
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("at_once: 2 runs, 100.0 %"));
  CHECK_THAT(text_in(folder.file("out") + "/report.md"), Contains("a success is the components' own word"));
}

TEST_CASE("a goal that no robot or place can meet is said with what there is, before anything runs",
          "[system][batch]") {
  const TempFolder folder;
  const Run run = run_simbatch({liars(folder,
                                      "<goal place=\"strat\" radius=\"0.3 m\"/>\n"
                                      "<goal robot=\"Pioner\" x=\"1 m\" y=\"1 m\" radius=\"0.3 m\"/>"),
                                "--out", folder.file("out")});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("liars.xml:1:"));
  CHECK(run.says(
      "E017: <goal>: a goal is at the place \"strat\", which this world does not have; it has: start,"));
  CHECK(run.says("did you mean \"start\"?"));
  CHECK(run.says(
      "E017: <goal>: a goal is for the robot \"Pioner\", which is not simulated; there are: Pioneer"));
  CHECK_FALSE(std::filesystem::exists(folder.file("out")));
}
