// SPDX-License-Identifier: GPL-3.0-or-later
// What a system costs grows with the number of its components, and not with its square: real components, started and checked.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <string>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr int kFew = kSanitized ? 250 : 1000;
constexpr int kTimes = 4;
// Between growth in proportion, which gives kTimes and less, and growth with the square, which gives kTimes * kTimes.
constexpr double kMost = 2 * kTimes;

// Processor time of the programs that this one has started and that have ended [s].
double used_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Pairs of which one pushes to the other.
std::string pairs(int components) {
  std::string text = "<graph name=\"many\" version=\"1\" plugins=\"" ORCA_BINARY_DIR "/tests/host_plugins\">";
  for (int i = 0; i < components / 2; ++i) {
    const std::string number = std::to_string(i);
    text +=
        "<component name=\"talker" + number + "\" type=\"test.Talker\"/><component name=\"teller" + number +
        "\" type=\"test.Teller\"><param name=\"tells\" value=\"false\"/></component><connect from=\"talker" +
        number + ".out\" to=\"teller" + number + ".in\"/>";
  }
  return text + "</graph>";
}

// Each of which starts after the next one of the file.
std::string row(int components) {
  std::string text = "<graph name=\"row\" version=\"1\" plugins=\"" ORCA_BINARY_DIR "/tests/host_plugins\">";
  for (int i = 0; i < components; ++i)
    text += "<component name=\"c" + std::to_string(i) + "\" type=\"test.Talker\"" +
            (i + 1 < components ? " start_after=\"c" + std::to_string(i + 1) + "\"/>" : "/>");
  return text + "</graph>";
}

// Thousands of avoiders, each with a Goto and a localizer, for one robot: as many components, twice as many connections.
std::string crowd(int components) {
  std::string text =
      "<graph name=\"crowd\" version=\"1\"><hardware name=\"scout\" type=\"orca.hw.Sim\"><param "
      "name=\"world\" "
      "value=\"" +
      source_file("sim/worlds/office.xml") + "\"/><param name=\"robot\" value=\"" +
      source_file("sim/robots/nomad_scout.urdf") +
      "\"/><param name=\"place\" value=\"start\"/></hardware>"
      "<component name=\"base\" type=\"orca.RobotBaseServer\" hardware=\"scout\"/>";
  std::string edges;
  for (int i = 0; i < components / 3; ++i) {
    const std::string number = std::to_string(i);
    const auto connect = [&](const std::string& from, const std::string& to) {
      edges += "<connect from=\"" + from + "\" to=\"" + to + "\"/>";
    };
    text += "<component name=\"localizer" + number +
            "\" type=\"orca.OdometryLocalizer\"/><component name=\"goto" + number +
            "\" type=\"orca.Goto\"/><component name=\"avoid" + number +
            "\" type=\"orca.SonarAvoid\" autonomous=\"true\"/>";
    connect("base.OdometryPush", "localizer" + number + ".odometry");
    connect("base.OdometryPush", "avoid" + number + ".odometry");
    connect("base.SonarRangeReadingsPush", "avoid" + number + ".sonar");
    connect("localizer" + number + ".RobotPosePush", "goto" + number + ".localizer");
    connect("localizer" + number + ".RobotPosePush", "avoid" + number + ".localizer");
    connect("goto" + number + ".GoalPush", "avoid" + number + ".goal");
  }
  return text + edges + "</graph>";
}

// The most memory that a program had which this one has started, or one of that program's own [MB].
double most_memory() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double seconds_for(const std::string& text, const Words& options) {
  const TempFolder folder;
  const double before = used_seconds();
  const Run run = run_deployer(Words{folder.write("graph.xml", text)} + options);
  INFO(run.err.substr(0, 2000));
  REQUIRE(run.exit_code() == 0);
  return used_seconds() - before;
}

}  // namespace

TEST_CASE("four times as many components take at most eight times as much processor time to start and to end",
          "[system][growth]") {
  const Words options{"--clock", "virtual", "--until", "1 ms", "--log", "error"};
  CHECK(seconds_for(pairs(kTimes * kFew), options) < kMost * seconds_for(pairs(kFew), options));
}

TEST_CASE("four times as many components take at most eight times as much processor time to be checked",
          "[system][growth]") {
  CHECK(seconds_for(pairs(kTimes * kFew), {"--check"}) < kMost * seconds_for(pairs(kFew), {"--check"}));
  CHECK(seconds_for(row(kTimes * kFew), {"--check"}) < kMost * seconds_for(row(kFew), {"--check"}));
}

TEST_CASE(
    "ten thousand shipped components with twenty thousand connections are checked with less than 500 MB",
    "[system][growth]") {
  const double seconds = seconds_for(crowd(10'000), {"--check", "--strict"});
  WARN("checked in " << seconds << " s of processor time, with " << most_memory() << " MB at most");
  if (!kSanitized) CHECK(most_memory() < 500.0);
}
