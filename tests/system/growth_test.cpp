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
