// SPDX-License-Identifier: GPL-3.0-or-later
// The fuser's modes, its stops and its reasons, in whole systems.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

Run past_the_pillar(const std::string& mode) {
  return run_deployer(Words{system_graph("symmetric.xml"), "--set", "mode=" + mode} + with_test_plugins() +
                      virtual_clock());
}

Run two_voices(const std::string& mode, const std::string& sync, const std::string& then) {
  return run_deployer(Words{system_graph("voices.xml"), "--set", "mode=" + mode, "--set", "sync=" + sync,
                            "--set", "then=" + then, "--until", "4 s"} +
                      with_test_plugins() + virtual_clock());
}

// Returns when the sink first reported something [s]; negative if never.
double told_at(const Run& run, const std::string& what) {
  for (const std::string& line : run.said(what))
    if (const auto time = line.find("t="); time != std::string::npos)
      return std::strtod(line.c_str() + time + 2, nullptr);
  return -1.0;
}

const std::vector<std::string> kModes{"weighted", "priority", "vote", "vector_sum", "subsumption"};
const std::vector<std::string> kSyncs{"any", "all", "period"};
constexpr double kPeriod = 0.05;  // the fuser's default
constexpr double kSilence = 0.3;  // three periods of the voices
constexpr double kWatch = 0.02;   // how often the fuser looks for silence

}  // namespace

TEST_CASE("between two behaviours that avoid a pillar on opposite sides the weighted mean drives into it",
          "[system][fuser]") {
  const Run run = past_the_pillar("weighted");
  INFO(run.err);
  CHECK_FALSE(run.contacts().empty());
}

TEST_CASE("a vote takes one of the two sides, passes the pillar and arrives", "[system][fuser]") {
  const Run run = past_the_pillar("vote");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("priority and subsumption pass the pillar too, because one behaviour decides alone",
          "[system][fuser]") {
  for (const char* mode : {"priority", "subsumption"}) {
    const Run run = past_the_pillar(mode);
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.contacts().empty());
    CHECK(run.arrivals().size() == 1);
  }
}

TEST_CASE("every mode gives the same trace again", "[system][fuser]") {
  for (const std::string& mode : kModes) {
    const Run run = past_the_pillar(mode);
    REQUIRE(run.trace_hash().has_value());
    CHECK(run.trace_hash() == past_the_pillar(mode).trace_hash());
  }
}

TEST_CASE("a full stop stops the robot within one period, in every mode, whenever the fuser fuses",
          "[system][fuser]") {
  for (const std::string& mode : kModes) {
    for (const std::string& sync : kSyncs) {
      const Run run = two_voices(mode, sync, "full_stop");
      INFO(run.err);
      CAPTURE(mode, sync);
      CHECK(told_at(run, mode + " FUSED by driver speed 0.30") < 1.0);
      const double stopped = told_at(run, mode + " TOLD_TO_STOP by guard speed 0.00");
      CHECK(stopped >= 2.0);
      CHECK(stopped <= 2.0 + 0.1 + kPeriod);  // the guard sends every 100 ms
    }
  }
}

TEST_CASE("a full stop is obeyed at once even if it holds a number that is not finite", "[system][fuser]") {
  const Run run = two_voices("weighted", "any", "full_stop_at_nan");
  INFO(run.err);
  const double stopped = told_at(run, "TOLD_TO_STOP by guard speed 0.00");
  CHECK(stopped >= 2.0);
  CHECK(stopped <= 2.0 + 0.1 + kPeriod);
}

TEST_CASE("a wish with a number that is not finite stops the robot at once, and it is said whose it was",
          "[system][fuser]") {
  const Run run = two_voices("weighted", "any", "drive_at_nan");
  INFO(run.err);
  const double stopped = told_at(run, "REQUIRED_SILENT by guard speed 0.00");
  CHECK(stopped >= 2.0);
  CHECK(stopped <= 2.0 + 0.1 + kPeriod);
  CHECK(run.says("the MotionCommand of \"guard\" counts as none: a motion command's speed is nan"));
  CHECK(run.says("stops the robot: nothing valid is heard of the behaviour \"guard\""));
}

TEST_CASE("a wish far beyond what robots do is asked about once, with the name of the behaviour",
          "[system][fuser]") {
  const auto asked = [](const std::string& what, const std::string& question) {
    const Run run = two_voices("weighted", "any", what);
    INFO(run.err);
    CHECK(run.ended);
    const std::vector<std::string> lines = split_lines(run.err);
    CHECK(std::ranges::count_if(lines, [](const std::string& line) {
            return line.find("did you mean") != line.npos || line.find("was it meant") != line.npos;
          }) == 1);
    CHECK(run.says("the behaviour \"guard\" wishes for " + question));
  };
  asked("turn_by_90", "a turn rate of 90 rad/s: did you mean degrees?");
  asked("drive_at_250", "a speed of 250 m/s: was it meant in mm/s or cm/s?");
}

TEST_CASE("each shipped graph lets no robot drive without its avoid behaviour, whatever a client list says",
          "[system][fuser]") {
  const std::regex component(
      R"x(<component name="([^"]*)" type="orca\.(\w+)"[^>]*?(/>|>([^]*?)</component>))x");
  const std::regex command(R"x(<connect from="([^"]*)\.motion" to="([^"]*)\.motion")x");
  const std::set<std::string> avoiders{"SonarAvoid", "LaserAvoid", "VfhPlus",
                                       "Dwa",        "NdPlus",     "PotentialField"};
  std::size_t found = 0;
  for (const std::string& graph : shipped_graphs()) {
    const std::string text = printed(graph);
    std::map<std::string, std::smatch> components;
    for (std::sregex_iterator at(text.begin(), text.end(), component), end; at != end; ++at)
      components[(*at)[1]] = *at;
    for (std::sregex_iterator at(text.begin(), text.end(), command), end; at != end; ++at) {
      const std::string behaviour = (*at)[1];
      if (!avoiders.contains(components[behaviour][2])) continue;
      ++found;
      INFO(graph << " " << behaviour);
      const std::string short_name = behaviour.substr(behaviour.rfind('/') + 1);
      CHECK(components[(*at)[2]][4].str().find("<param name=\"required\" value=\"" + short_name + "\"") !=
            std::string::npos);
    }
  }
  CHECK(found >= 20);
}

TEST_CASE("a client list without the required avoid behaviour does not drive the robot, and it is said why",
          "[system][fuser]") {
  ShippedGraph graph("scout_goto");
  std::string text = graph.text();
  const std::string both = "value=\"goto; avoid\"";
  REQUIRE(text.find(both) != std::string::npos);
  text.replace(text.find(both), both.size(), "value=\"goto\"");
  const TempFolder folder;
  const Run run = run_deployer(Words{folder.write("blind.xml", text), "--until", "60 s"} + virtual_clock());
  INFO(run.err);
  CHECK(run.contacts().empty());
  CHECK(run.arrivals().empty());
  CHECK(run.says("stops the robot: the client list leaves out the behaviour \"avoid\", which is required"));
}

TEST_CASE("a behaviour that falls silent for three of its periods stops the robot, in every mode",
          "[system][fuser]") {
  for (const std::string& mode : kModes) {
    const Run run = two_voices(mode, "any", "silence");
    INFO(run.err);
    CAPTURE(mode);
    CHECK(told_at(run, "FUSED by driver speed 0.30") < 1.0);
    const double stopped = told_at(run, "REQUIRED_SILENT by guard speed 0.00");
    CHECK(stopped >= 1.9 + kSilence);  // the guard last speaks at 1.9 s
    CHECK(stopped <= 2.0 + kSilence + kWatch);
    CHECK(run.says("stops the robot: nothing is heard of the behaviour \"guard\""));
  }
}

TEST_CASE("when all behaviours fall silent the robot is stopped, and it is said why", "[system][fuser]") {
  for (const std::string& sync : kSyncs) {
    const Run run = run_deployer(Words{system_graph("voices.xml"), "--set", "then=silence", "--set",
                                       "driver_then=silence", "--set", "sync=" + sync, "--until", "4 s"} +
                                 with_test_plugins() + virtual_clock());
    INFO(run.err);
    CAPTURE(sync);
    const double stopped = told_at(run, "REQUIRED_SILENT");
    CHECK(stopped >= 1.9 + kSilence);
    CHECK(stopped <= 2.0 + kSilence + kPeriod);
    CHECK(run.says("stops the robot: nothing is heard of the behaviour"));
  }
}

TEST_CASE("a behaviour that grows ten times slower than it announces stops the robot", "[system][fuser]") {
  const Run run = two_voices("weighted", "any", "slow");
  INFO(run.err);
  const double stopped = told_at(run, "REQUIRED_SILENT by guard speed 0.00");
  CHECK(stopped >= 1.9 + kSilence);
  CHECK(stopped <= 2.0 + kSilence + kWatch);
}

TEST_CASE("nobody is called silent before there was time to speak", "[system][fuser]") {
  const Run run = two_voices("weighted", "any", "no_opinion");
  INFO(run.err);
  CHECK_FALSE(run.says("nothing is heard"));
  CHECK(told_at(run, "FUSED by driver speed 0.30") < 1.0);
}

TEST_CASE("a behaviour that the graph calls optional may fall silent", "[system][fuser]") {
  const Run run = run_deployer(Words{system_graph("voices.xml"), "--set", "then=silence", "--set",
                                     "optional=guard", "--until", "4 s"} +
                               with_test_plugins() + virtual_clock());
  INFO(run.err);
  CHECK(told_at(run, "FUSED by driver speed 0.30") >= 0.0);
  CHECK(told_at(run, "speed 0.00") >= 4.0);  // at the end of the run
}

TEST_CASE(
    "a required behaviour that is not connected is refused at the start: the robot would stand for good",
    "[system][fuser]") {
  const Run run = run_deployer(
      Words{system_graph("voices.xml"), "--set", "then=silence", "--set", "required=gard", "--until", "4 s"} +
      with_test_plugins() + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == kRefusedByComponent);
  CHECK(run.says("no behaviour \"gard\" is connected to fuser.motion; connected are:"));
  CHECK(run.out.find("trace-hash") == std::string::npos);  // nothing ran
}

TEST_CASE("an unknown mode is refused with those that there are; priority without an order does not start",
          "[system][fuser]") {
  const Words graph = Words{system_graph("voices.xml"), "--set", "then=silence"} + with_test_plugins();
  const Run unknown = run_deployer(graph + Words{"--set", "mode=voting"} + virtual_clock());
  CHECK(unknown.exit_code() == 2);
  CHECK(unknown.says("vote"));
  const Run unordered =
      run_deployer(graph + Words{"--set", "mode=priority", "--set", "order="} + virtual_clock());
  CHECK(unordered.exit_code() == kRefusedByComponent);
  CHECK(unordered.says("mode priority needs the parameter order"));
}

TEST_CASE("reasons that nobody else takes are made for a recording, and change nothing of the run",
          "[system][fuser]") {
  const TempFolder folder;
  const Words run{source_file("graphs/scout_goto.xml"), "--until", "5 s"};
  const Run plain = run_deployer(run + virtual_clock());
  const std::string file = folder.file("reasons.csv");
  const Run recorded =
      run_deployer(run + virtual_clock() + Words{"--record", file + "=fuser.FusionReasonPush"});
  INFO(recorded.err);
  REQUIRE(plain.trace_hash());
  CHECK(recorded.trace_hash() == plain.trace_hash());
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  CHECK(split_lines(text).size() > 20);
}
