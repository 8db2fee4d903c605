// SPDX-License-Identifier: GPL-3.0-or-later
// --trace FILE --values: two runs can be compared to the first differing number.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

// Runs a component that says one thing until 0.15 s and another from then on, for three laps.
struct Traced {
  std::vector<std::string> lines;
  std::string hash;
};

Traced run_with(const std::string& then, const Words& more) {
  const TempFolder folder;
  const Run run = run_deployer(Words{system_graph("one_voice.xml"), "--set", "then=" + then, "--until",
                                     "0.25 s", "--trace", folder.file("trace")} +
                               with_test_plugins() + virtual_clock() + more);
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  REQUIRE(run.trace_hash());
  return {split_lines(read_text(folder.file("trace"))), *run.trace_hash()};
}

std::vector<std::size_t> differing_lines(const Traced& a, const Traced& b) {
  std::vector<std::size_t> numbers;
  REQUIRE(a.lines.size() == b.lines.size());
  for (std::size_t i = 0; i < a.lines.size(); ++i)
    if (a.lines[i] != b.lines[i]) numbers.push_back(i);
  return numbers;
}

}  // namespace

TEST_CASE("runs that differ in one payload have traces that differ in its line, with values only",
          "[system][values]") {
  const Traced stop = run_with("full_stop", {});
  const Traced drive = run_with("drive", {});
  CHECK(stop.hash != drive.hash);
  CHECK(differing_lines(stop, drive).empty());

  const Traced stop_values = run_with("full_stop", {"--values"});
  const Traced drive_values = run_with("drive", {"--values"});
  const std::vector<std::size_t> lines = differing_lines(stop_values, drive_values);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(stop_values.lines[lines.front()],
             Contains("deliver sink motion 3 MotionCommand from voice <MotionCommand ") &&
                 Contains("kind=\"FULLSTOP\""));
  CHECK_THAT(drive_values.lines[lines.front()], Contains("kind=\"NORMAL\"") && Contains("speed=\"0.3\""));
  CHECK(stop_values.hash == stop.hash);
}

TEST_CASE("--values without --trace is refused", "[system][values]") {
  const Run run = run_deployer({source_file("graphs/scout_goto.xml"), "--values", "--check"});
  CHECK(run.exit_code() == 2);
  CHECK(run.says("C004: --values goes with --trace FILE"));
}
