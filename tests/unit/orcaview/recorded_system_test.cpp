// SPDX-License-Identifier: GPL-3.0-or-later
// What a recorded system says, at any of its times.
#include "replay/recorded_system.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/recording/objects/object_writer.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::view;
using namespace orca::test;

namespace {

TimePoint after(double seconds) { return TimePoint(from_seconds(100.0 + seconds)); }
recording::Stamp stamp(double seconds) {
  return static_cast<recording::Stamp>(after(seconds).time_since_epoch().count());
}

ObjectRef alarm(bool is_active) {
  Loan<idl::Alarm> alarm = make_object<idl::Alarm>();
  alarm->kind(idl::HARDWARE_FAULT);
  alarm->source("scout");
  alarm->text("it is silent");
  alarm->active(is_active);
  return std::move(alarm).seal();
}

// Ten seconds of odometry, ten times a second, an alarm from 2 s to 5 s, and a line of the log at 7 s.
RecordedSystem recorded(const TempFolder& folder, bool has_graph) {
  const std::string path = folder.file("run.mcap");
  recording::ObjectWriter writer(*recording::open_file(path));
  REQUIRE(writer.begin({"test", false, {"base.OdometryPush"}, {}}).ok());
  if (has_graph) {
    REQUIRE(writer
                .attach_json("graph.json",
                             R"({"components": [{"name": "base", "type": "orca.Base", "process": "main"}]})")
                .ok());
    REQUIRE(
        writer.attach_json("ports.json", R"([{"port": "x.odometry", "connected_to": ["base.OdometryPush"]}])")
            .ok());
  }
  for (int i = 0; i < 100; ++i) {
    const TimePoint now = after(0.1 * i);
    Loan<idl::Odometry> odometry = make_object<idl::Odometry>();
    odometry->x(i);
    REQUIRE(writer.add("base.OdometryPush", std::move(odometry).seal(), now).ok());
    if (i == 20 || i == 50) REQUIRE(writer.add(recording::kAlarmRow, alarm(i == 20), now).ok());
    if (i == 70)
      REQUIRE(
          writer
              .add(recording::kLogRow, recording::log_record(log::Level::warning, "base", "slips", now), now)
              .ok());
  }
  REQUIRE(writer.close({}, {}).ok());
  Result<RecordedSystem> system = RecordedSystem::open(path);
  REQUIRE(system);
  return *std::move(system);
}

}  // namespace

TEST_CASE("the last object of a port at a time is found, whatever chunk it is in", "[orcaview][recorded]") {
  const TempFolder folder;
  const RecordedSystem system = recorded(folder, true);
  for (const double time : {0.0, 0.26, 4.0, 9.9, 60.0}) {
    const auto last = system.last("base.OdometryPush", stamp(time));
    REQUIRE(last);
    CHECK(last->type == "Odometry");
    CHECK(last->passed == stamp(std::min(9.9, std::floor(time * 10.0 + 1e-9) / 10.0)));
  }
  CHECK_FALSE(system.last("base.OdometryPush", stamp(-1.0)));
  CHECK_FALSE(system.last(std::string(recording::kAlarmRow), stamp(1.9)));
}

TEST_CASE("what passes in a span of time comes in its order, until it is enough", "[orcaview][recorded]") {
  const TempFolder folder;
  const RecordedSystem system = recorded(folder, true);
  std::vector<recording::Stamp> times;
  const auto take = [&](const std::string& row, const supervisor::Tapped& passed) {
    CHECK(row == "base.OdometryPush");
    times.push_back(passed.passed);
    return times.size() < 15;
  };
  REQUIRE(system.pass({"base.OdometryPush"}, stamp(3.0), stamp(3.5), take).ok());
  REQUIRE(times.size() == 6);
  CHECK(times.front() == stamp(3.0));
  CHECK(times.back() == stamp(3.5));
  REQUIRE(system.pass({"base.OdometryPush"}, stamp(5.0), stamp(9.0), take).ok());
  CHECK(times.size() == 15);
  REQUIRE(system.pass({"nobody.knows"}, stamp(0.0), stamp(9.0), take).ok());
  CHECK(times.size() == 15);
}

TEST_CASE("alarms and lines of the log are those of the time", "[orcaview][recorded]") {
  const TempFolder folder;
  const RecordedSystem system = recorded(folder, true);
  CHECK(system.alarms(stamp(1.9)).empty());
  const auto alarms = system.alarms(stamp(3.0));
  REQUIRE(alarms.size() == 1);
  CHECK(alarms[0][3].value == "HARDWARE_FAULT");
  CHECK(std::stod(alarms[0][1].value) == Approx(2.0));  // since the beginning, as the lines of the log
  CHECK(system.alarms(stamp(5.0)).empty());
  CHECK(system.log(stamp(0.0), stamp(6.9), {}).empty());
  const auto lines = system.newest_log(stamp(7.0), {});
  REQUIRE(lines.size() == 1);
  CHECK(lines[0][1].value == "warning");
  CHECK(lines[0][3].value == "slips");
  CHECK(system.log(stamp(0.0), stamp(7.0), {"base", "goto"}).size() == 1);
  CHECK(system.log(stamp(0.0), stamp(7.0), {"goto"}).empty());
}

TEST_CASE("the graph is the recorded one; without it the ports that are recorded are there",
          "[orcaview][recorded]") {
  const TempFolder folder;
  const RecordedSystem system = recorded(folder, true);
  REQUIRE(system.components().size() == 1);
  CHECK(system.components()[0][1].value == "orca.Base");
  CHECK(system.row_of("x.odometry") == "base.OdometryPush");  // which is connected to it
  CHECK(system.row_of("x.nothing").empty());
  const TempFolder other;
  const RecordedSystem bare = recorded(other, false);
  REQUIRE(bare.components().size() == 1);
  CHECK(bare.components()[0][0].value == "base");
  CHECK_THAT(bare.ports(), Catch::Contains("\"base.OdometryPush\""));
  CHECK(bare.row_of("x.odometry").empty());
}
