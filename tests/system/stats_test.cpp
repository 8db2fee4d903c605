// SPDX-License-Identifier: GPL-3.0-or-later
// What a user sees of connections that do not keep up: a line in the log, and the numbers of --stats.
#include <catch2/catch.hpp>

#include <map>
#include <sstream>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kGraph = source_file("graphs/scout_goto.xml");
const std::string kOdometry = "base.OdometryPush -> avoid.odometry";

// Returns scout_goto.xml with more attributes for the connection to this port, and absolute paths.
std::string scout_graph(const std::string& port, const std::string& attributes) {
  std::string text = read_text(kGraph);
  const std::string edge = "to=\"" + port + "\"";
  const std::vector<std::pair<std::string, std::string>> all{
      {"\"../sim/worlds", "\"" + source_file("sim/worlds")},
      {"\"../sim/robots", "\"" + source_file("sim/robots")},
      {edge, edge + " " + attributes}};
  for (const auto& [from, to] : all) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  }
  return text;
}

Run drive(const std::string& port, const std::string& attributes) {
  const TempFolder folder;
  return run_deployer(
      Words{folder.write("graph.xml", scout_graph(port, attributes)), "--until", "5 s", "--stats"} +
      virtual_clock());
}

std::vector<std::string> lines_with(const std::string& text, const std::string& part) {
  std::vector<std::string> found = split_lines(text);
  std::erase_if(found, [&](const std::string& line) { return line.find(part) == std::string::npos; });
  return found;
}

// Returns the numbers of a row of the table, by their columns.
std::map<std::string, long> row_of(const std::string& text, const std::string& name) {
  const std::vector<std::string> rows = lines_with(text, name + " ");
  REQUIRE(rows.size() == 1);
  std::istringstream words(rows.front().substr(name.size()));
  std::map<std::string, long> row;
  for (const char* column : {"delivered", "dropped", "unread", "late", "high water"}) words >> row[column];
  CHECK(words);
  return row;
}

}  // namespace

TEST_CASE("a run in which every connection keeps up says so", "[system][stats]") {
  const Run run = drive("avoid.odometry", "");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(lines_with(run.err, "warning").empty());
  const auto odometry = row_of(run.err, kOdometry);
  CHECK(odometry.at("delivered") >= 99);
  CHECK(odometry.at("dropped") == 0);
  CHECK(odometry.at("late") == 0);
  CHECK(odometry.at("high water") == 1);
  CHECK(lines_with(run.err, "no drops beyond a limit, no missed deadlines, no refusals").size() == 1);
}

TEST_CASE("a stream that is later than its deadline is one line in the log, and a number",
          "[system][stats]") {
  const Run run = drive("avoid.odometry", "deadline=\"1 ms\"");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const std::vector<std::string> warnings = lines_with(run.err, "warning");
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(
      warnings.front(),
      Contains("avoid: base.OdometryPush to avoid.odometry: no object within the deadline of 0.001 s"));
  const auto odometry = row_of(run.err, kOdometry);
  CHECK(odometry.at("late") > 40 * odometry.at("delivered"));  // an object each 50 ms
  CHECK(lines_with(run.err, ", " + std::to_string(odometry.at("late")) + " missed deadlines, ").size() == 1);
  CHECK(run.trace_hash() == drive("avoid.odometry", "").trace_hash());
}

TEST_CASE("a connection that drops more than it may is one line in the log, and a number",
          "[system][stats]") {
  const Run run = drive("avoid.localizer", "drop_limit=\"10\"");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const std::vector<std::string> warnings = lines_with(run.err, "warning");
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings.front(), Contains("avoid: localizer.RobotPosePush to avoid.localizer: objects dropped "
                                        "so far: 11, drop_limit: 10 (queue latest)"));
  const long dropped = row_of(run.err, "localizer.RobotPosePush -> avoid.localizer").at("dropped");
  CHECK(dropped > 40);
  CHECK(lines_with(run.err, std::to_string(dropped - 10) + " drops beyond a limit, ").size() == 1);
}

TEST_CASE("the table goes to stderr, without it nothing does", "[system][stats]") {
  const Run with = run_deployer(Words{kGraph, "--until", "1 s", "--stats"} + virtual_clock());
  const Run without = run_deployer(Words{kGraph, "--until", "1 s"} + virtual_clock());
  CHECK(with.out == without.out);
  CHECK(with.says("high water"));
  CHECK(with.says("timed out"));
  CHECK_FALSE(without.says("high water"));
}
