// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/reporting/line_limit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>

#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;

namespace {

constexpr TimePoint at(Duration time) { return TimePoint(time); }

}  // namespace

TEST_CASE("the first line about a thing is written, the next ones only after the interval", "[host][log]") {
  LineLimit limit(10s);
  CHECK(limit.admit("a", at(5s)) == 0);
  CHECK_FALSE(limit.admit("a", at(5s)));
  CHECK_FALSE(limit.admit("a", at(15s - 1ns)));
  CHECK(limit.admit("a", at(15s)));
  CHECK_FALSE(limit.admit("a", at(16s)));
}

TEST_CASE("a line says how many were left out since the last one, each once", "[host][log]") {
  LineLimit limit(10s);
  CHECK(limit.admit("a", at(0s)) == 0);
  for (int i = 1; i <= 3; ++i) CHECK_FALSE(limit.admit("a", at(1s)));
  CHECK(limit.admit("a", at(10s)) == 3);
  CHECK(limit.admit("a", at(20s)) == 0);
}

TEST_CASE("lines about different things do not limit each other", "[host][log]") {
  LineLimit limit(10s);
  CHECK(limit.admit("a", at(0s)) == 0);
  CHECK(limit.admit("b", at(1s)) == 0);
  CHECK_FALSE(limit.admit("a", at(2s)));
  CHECK(limit.admit("b", at(11s)) == 0);
  CHECK(limit.admit("a", at(11s)) == 1);
}

TEST_CASE("a command that is refused over and over is one line in 10 s", "[host][log]") {
  RunOptions options = test::virtual_run();
  options.until = 15s;
  const test::RecordedRun run = test::record_run("", R"x(
    <component name="fuser" type="orca.MotionCommandFuser"><param name="clients" value="ahead"/></component>
    <component name="ahead" type="test.Wisher"/>
    <component name="wheels" type="test.Wheels"><param name="held" value="true"/></component>
    <connect from="ahead.motion" to="fuser.motion"/>
    <connect from="fuser.base" to="wheels.motion"/>)x",
                                                 options);
  const std::string line =
      "wheels: motion: could not handle an object that it had accepted: the wheels are held";
  std::vector<std::string> told;
  std::ranges::copy_if(run.warnings, std::back_inserter(told),
                       [&](const std::string& warning) { return warning.starts_with(line); });
  CHECK(told == std::vector<std::string>{line, line + " (99 more such lines were left out before)"});
}
