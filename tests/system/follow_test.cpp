// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that follows a person through an office.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

Run follow(const Words& more, const std::string& graph = "pioneer_follow") {
  const TempFolder folder;
  return run_deployer(Words{source_file("graphs/" + graph + ".xml")} + virtual_clock() +
                          needed_arguments(graph, folder) + more,
                      Seconds(60));
}

// Returns how far the robot was driven [m], by the account of its gate.
double way_of(const Run& run) {
  const std::string account = "gate: in ";
  const auto at = run.err.rfind(account);
  REQUIRE(at != std::string::npos);
  return std::strtod(run.err.c_str() + at + account.size(), nullptr);
}

// Returns how far it has come in the world [m], by a table of its true poses; the gate gives no account where it had nothing to do.
double way_in(const std::string& table) {
  const std::vector<std::string> lines = split_lines(read_text(table));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> found;
    std::istringstream rest(line);
    for (std::string cell; std::getline(rest, cell, ',');) found.push_back(cell);
    return found;
  };
  const std::vector<std::string> names = cells(lines.at(0));
  const auto column = static_cast<std::size_t>(std::ranges::find(names, "x") - names.begin());
  const auto x = [&](const std::string& line) { return std::stod(cells(line).at(column)); };
  return x(lines.back()) - x(lines.at(1));
}

}  // namespace

TEST_CASE("a robot follows a guide through three doors, twice round, and touches nothing",
          "[system][follow]") {
  const Run run = follow({"--until", "80 s"});
  INFO(run.err);
  CHECK(run.says("follows somebody"));
  CHECK_FALSE(run.says("PERSON_LOST"));
  CHECK(way_of(run) > 0.85 * 0.5 * 80.0);  // The guide walks at 0.5 m/s.
  CHECK(run.contacts().empty());
}

TEST_CASE("a robot that is too slow for its guide says that it has lost him", "[system][follow]") {
  // Later its guide comes round, and walks into it from behind while it stands.
  const Run run = follow({"--set", "follow.max_speed=0.15 m/s", "--until", "35 s"});
  INFO(run.err);
  CHECK(run.says("follow: alarm PERSON_LOST: it does not see any more whom it follows"));
  CHECK(run.contacts().empty());
}

TEST_CASE("a robot follows a guide by the colour that its camera sees", "[system][follow][camera]") {
  const Run run = follow({"--until", "80 s"}, "camera");
  INFO(run.err);
  CHECK(run.says("follows somebody"));
  CHECK_FALSE(run.says("PERSON_LOST"));
  CHECK(way_of(run) > 0.85 * 0.5 * 80.0);
  CHECK(run.contacts().empty());
}

// A laser cannot tell somebody who walks straight away from what stands; the colour can be told.
TEST_CASE("who walks straight away is followed by colour, and not by a laser", "[system][follow][camera]") {
  const Words away{"--set", "world=" + source_file("sim/worlds/office_ahead.xml"), "--until", "12 s"};
  const TempFolder folder;
  const std::string table = folder.file("poses.csv");
  const Run by_colour = follow(
      away + Words{"--profile", "sim", "--profile", "truth", "--record", table + "=truth.RobotPosePush"},
      "camera");
  INFO(by_colour.err);
  CHECK(by_colour.says("follows somebody"));
  CHECK(way_in(table) > 0.8 * 0.5 * 12.0);  // The guide walks at 0.5 m/s.
  CHECK(by_colour.contacts().empty());
  CHECK_FALSE(follow(away).says("follows somebody"));
}

TEST_CASE("without its camera, or with the eye on another colour, the robot follows nobody",
          "[system][follow][camera]") {
  for (const Words& more : {Words{"--fail", "vest=silent@0.001s"}, Words{"--set", "colour=#00a040"}}) {
    const Run run = follow(more + Words{"--until", "15 s"}, "camera");
    INFO(run.err);
    CHECK_FALSE(run.says("follows somebody"));
  }
}

TEST_CASE("a colour that is none is refused with what to write", "[system][follow][camera]") {
  const Run run = follow({"--set", "colour=orange", "--check"}, "camera");
  CHECK(run.exit_code() == 2);
  CHECK(run.says("\"orange\" is no colour; write # and two hexadecimal digits"));
}
