// SPDX-License-Identifier: GPL-3.0-or-later
// A behaviour of a shipped graph fails while the robot drives: the robot is stopped, and the screen says why.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <optional>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

const std::vector<std::pair<std::string, std::vector<std::string>>> kDrivers{
    {"scout_goto", {"goto", "avoid"}},         {"scout_gallery", {"goto", "avoid"}},
    {"scout_rounds", {"goto", "avoid"}},       {"scout_odometry", {"goto", "avoid"}},
    {"pioneer_laser_goto", {"goto", "avoid"}}, {"random_walk", {"walk", "avoid"}},
};

constexpr double kFailsAt = 10.0;
// The longest silence of a behaviour that announces 100 ms, less what had passed of the period, and a watch period.
constexpr double kStopLimit = 0.3 + 0.02;
constexpr double kRestLimit = 0.5;  // [s] from the failure until the robot is at rest

Run drive(const std::string& name, const std::string& behaviour, const std::string& how) {
  const TempFolder folder;
  ShippedGraph graph(name);
  graph.watch_motion("base");
  return run_deployer(Words{folder.write("graph.xml", graph.text()), "--until", "30 s", "--fail",
                            behaviour + "=" + how + "@10s"} +
                      virtual_clock());
}

// Returns the time of the last line of the log that holds a text [s].
std::optional<double> last_time(const Run& run, const std::string& text) {
  std::optional<double> time;
  for (const std::string& line : split_lines(run.err))
    if (line.starts_with("[") && line.find(text) != std::string::npos)
      time = std::strtod(line.c_str() + 1, nullptr);
  return time;
}

}  // namespace

TEST_CASE(
    "silence, an exception, a hang or slowness of any behaviour stops a shipped robot for good, and it is "
    "said why",
    "[system][failure]") {
  for (const auto& [graph, behaviours] : kDrivers) {
    for (const std::string& behaviour : behaviours) {
      for (const char* how : {"silent", "throw", "hang", "slow"}) {
        CAPTURE(graph, behaviour, how);
        const Run run = drive(graph, behaviour, how);
        INFO(run.err);
        const auto stopped =
            last_time(run, "stops the robot: nothing is heard of the behaviour \"" + behaviour + "\"");
        REQUIRE(stopped);
        CHECK(*stopped >= kFailsAt);
        CHECK(*stopped <= kFailsAt + kStopLimit);
        const auto rests = last_time(run, "watch: rests after");
        REQUIRE(rests);
        CHECK(*rests > kFailsAt);
        CHECK(*rests <= kFailsAt + kRestLimit);
        CHECK(last_time(run, "watch: moves after") < rests);
        CHECK(run.contacts().empty());
      }
    }
  }
}

TEST_CASE("a rehearsed failure is told as one, and a run without it has another trace", "[system][failure]") {
  const Words graph{source_file("graphs/scout_goto.xml"), "--until", "12 s"};
  const Run whole = run_deployer(graph + virtual_clock());
  const Run failing = run_deployer(graph + Words{"--fail", "avoid=silent@10s"} + virtual_clock());
  CHECK(failing.says("avoid: fails from now on, because --fail asks for it"));
  CHECK_FALSE(whole.says("--fail"));
  CHECK(failing.trace_hash() != whole.trace_hash());
  CHECK(failing.trace_hash() ==
        run_deployer(graph + Words{"--fail", "avoid=silent@10s"} + virtual_clock()).trace_hash());
}

TEST_CASE("unknown components that are to fail are reported with what else is wrong, by --check too",
          "[system][failure]") {
  const Words graph{source_file("graphs/scout_goto.xml"),
                    "--fail",
                    "avoi=silent@1s",
                    "--fail",
                    "nobody=hang@1s",
                    "--set",
                    "base.max_age=1",
                    "--until",
                    "1 s"};
  for (const Words& words : {graph, graph + Words{"--check"}}) {
    const Run run = run_deployer(words + virtual_clock());
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.out.empty());
    CHECK(run.says(
        "command line: error G016: --fail avoi: there is no component \"avoi\"; did you mean \"avoid\"?"));
    CHECK(run.says(
        "command line: error G016: --fail nobody: there is no component \"nobody\"; the graph has: "));
    CHECK(run.says("command line: error G029: component \"base\""));
    CHECK(split_lines(run.err).size() == 3);
  }
}

TEST_CASE("a component is to fail once only", "[system][failure]") {
  const Run run = run_deployer({source_file("graphs/scout_goto.xml"), "--fail", "avoid=slow@1s", "--fail",
                                "goto=hang@1s", "--fail", "avoid=hang@2s", "--check"});
  CHECK(run.exit_code() == 2);
  CHECK(run.says("--fail: \"avoid\" is to fail twice"));
}

TEST_CASE("a failure that cannot be rehearsed is refused, with what was expected", "[system][failure]") {
  const auto refused = [](const std::string& fault) {
    const Run run = run_deployer({source_file("graphs/scout_goto.xml"), "--fail", fault, "--until", "1 s"});
    CHECK(run.exit_code() == 2);
    return run.err;
  };
  CHECK_THAT(refused("avoi=silent@1s"),
             Catch::Contains("no component \"avoi\"") && Catch::Contains("\"avoid\""));
  CHECK_THAT(refused("avoid=dead@1s"), Catch::Contains("silent, throw, hang, slow"));
  CHECK_THAT(refused("avoid"), Catch::Contains("COMPONENT=HOW@TIME"));
  CHECK_THAT(refused("avoid=silent"), Catch::Contains("COMPONENT=HOW@TIME"));
  CHECK_THAT(refused("avoid=silent@1 parsec"), Catch::Contains("--fail: "));
}
