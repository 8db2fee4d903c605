// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/component/parts/lap_meter.hpp"

#include <catch2/catch.hpp>

#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

TEST_CASE("a meter of laps knows how many there were, their sum exactly, and their quantiles to 6 %",
          "[host][laps]") {
  LapMeter meter;
  CHECK(meter.summary().laps == 0);
  CHECK(meter.summary().quantiles.empty());
  for (int i = 1; i <= 1000; ++i) meter.add(i * 10us);
  const LapTimes times = meter.summary();
  CHECK(times.laps == 1000);
  CHECK(times.total == Approx(5.005));
  REQUIRE(times.quantiles.size() == LapTimes::kQuantiles);
  CHECK(times.quantiles.front() == Approx(10e-6).epsilon(0.06));
  CHECK(times.quantiles[10] == Approx(5e-3).epsilon(0.06));
  CHECK(times.quantiles[19] == Approx(9.5e-3).epsilon(0.06));
  CHECK(times.quantiles.back() == Approx(10e-3).epsilon(0.06));
}

TEST_CASE("one lap is all quantiles, and one too short to be measured counts as 16 ns", "[host][laps]") {
  LapMeter one;
  one.add(7ms);
  for (const double time : one.summary().quantiles) CHECK(time == Approx(7e-3).epsilon(0.06));
  LapMeter none;
  none.add(0ns);
  CHECK(none.summary().quantiles.back() == Approx(16e-9).epsilon(0.06));
}

TEST_CASE("a run measures the processor time of laps if it is asked to, and its trace stays the same",
          "[host][laps]") {
  const std::string elements = R"(<component name="arriver" type="test.Arriver"/>
    <component name="relay" type="test.Relay"/><connect from="arriver.out" to="relay.in"/>)";
  RunOptions options = virtual_run();
  options.until = 1s;
  const RecordedRun plain = record_run("", elements, options);
  CHECK(plain.result.lap_times.empty());
  options.measures_laps = true;
  const RecordedRun measured = record_run("", elements, options);
  CHECK(measured.result.trace_hash == plain.result.trace_hash);
  REQUIRE(measured.result.lap_times.size() == 2);
  const LapTimes& relay = measured.result.lap_times.at("relay");
  CHECK(relay.laps == 10);
  CHECK(relay.total > 0.0);
  CHECK(relay.total < 1.0);
}
