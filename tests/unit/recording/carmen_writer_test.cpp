// SPDX-License-Identifier: GPL-3.0-or-later
// Objects written as a log of CARMEN: where the robot was at a scan, and what does not come into the log.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "memory_output.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/recording/carmen/log.hpp"
#include "orca/recording/objects/carmen_writer.hpp"

using namespace orca;
using namespace orca::recording;
using Catch::Contains;

namespace {

const std::string kBase = "base.OdometryPush";
const std::string kLaser = "laser.LaserRangeReadingsPush";

// A robot on a circle of 0.5 m to the left, at 0.5 m/s and 1 rad/s.
Pose2 pose_at(double time) { return {0.5 * std::sin(time), 0.5 - 0.5 * std::cos(time), time}; }

ObjectRef odometry_of(const Pose2& X_OB, double time) {
  Loan<idl::Odometry> odometry = make_object<idl::Odometry>();
  odometry->x(X_OB.x);
  odometry->y(X_OB.y);
  odometry->steer_angle(X_OB.yaw);
  odometry->translational_velocity(0.5);
  odometry->steering_velocity(1.0);
  odometry->stamp(to_time_value(TimePoint(from_seconds(time))));
  return std::move(odometry).seal();
}

ObjectRef odometry_at(double time) { return odometry_of(pose_at(time), time); }

ObjectRef scan_at(double time, double mount = 0.2) {
  Loan<idl::LaserRangeReadings> scan = make_object<idl::LaserRangeReadings>();
  scan->ranges({1.0, 2.0, 3.0});
  scan->max_range(8.0);
  scan->angle_start(-0.5);
  scan->angle_increment(0.5);
  scan->pose().position().x(mount);
  scan->stamp(to_time_value(TimePoint(from_seconds(time))));
  return std::move(scan).seal();
}

// The kinds of lines in a text, such as "ODOM ROBOTLASER1".
std::string kinds_of(const std::string& text) {
  std::string kinds;
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    if (!text.substr(at).starts_with("PARAM"))
      kinds += (kinds.empty() ? "" : " ") + text.substr(at, text.find(' ', at) - at);
  return kinds;
}

carmen::Log log_of(std::string_view text) {
  const Result<carmen::Log> log = carmen::read_log([&] { return std::exchange(text, {}); });
  REQUIRE(log);
  return *log;
}

std::vector<carmen::Entry> scans_of(const std::string& text) {
  std::vector<carmen::Entry> scans = log_of(text).entries;
  std::erase_if(scans, [](const carmen::Entry& entry) {
    return !std::holds_alternative<carmen::ScanLine>(entry.what.content);
  });
  return scans;
}

}  // namespace

TEST_CASE("a scan's line says where odometry had the robot at the scan's stamp, whenever it came",
          "[recording][carmen]") {
  CarmenText text;
  std::string all = text.text_of(kBase, odometry_at(1.0));
  const bool comes_late = GENERATE(false, true);
  if (comes_late) {
    all += text.text_of(kBase, odometry_at(1.1));
    CHECK(kinds_of(text.text_of(kLaser, scan_at(1.05))) == "ROBOTLASER1");
  }
  CHECK(text.text_of(kLaser, scan_at(1.175)).empty());  // it waits
  const std::string lines = text.text_of(kBase, odometry_at(1.2));
  CHECK(kinds_of(lines) == "ROBOTLASER1 ODOM");
  all += lines;
  const auto scans = scans_of(all);
  REQUIRE(scans.size() == 1);
  const auto& scan = std::get<carmen::ScanLine>(scans[0].what.content);
  const Pose2 X_OB = pose_at(1.175);
  CHECK(scan.X_OB.x == Approx(X_OB.x).margin(1e-6));
  CHECK(scan.X_OB.y == Approx(X_OB.y).margin(1e-6));
  CHECK(scan.X_OB.yaw == Approx(X_OB.yaw).margin(1e-6));
  const Pose2 X_OL = X_OB * Pose2{0.2, 0.0, 0.0};
  CHECK(scan.X_OL.x == Approx(X_OL.x).margin(1e-6));
  CHECK(scan.X_OL.y == Approx(X_OL.y).margin(1e-6));
  CHECK(scan.speed == Approx(0.5));
}

TEST_CASE("scans after which no odometry comes are in the log, with the odometry that was the last",
          "[recording][carmen]") {
  CarmenText text;
  std::string all = text.text_of(kBase, odometry_at(1.0));
  for (int i = 1; i <= 30; ++i) all += text.text_of(kLaser, scan_at(1.0 + 0.1 * i));
  CHECK(scans_of(all).size() == 10);  // the others wait
  const bool is_set_back = GENERATE(false, true);
  all += is_set_back ? text.text_of(kBase, odometry_at(0.5)) : text.ending();
  const auto scans = scans_of(all);
  REQUIRE(scans.size() == 30);
  for (const carmen::Entry& entry : scans)
    CHECK(std::get<carmen::ScanLine>(entry.what.content).X_OB.yaw == Approx(1.0));
  CHECK(text.check().ok());
  CHECK(text.lines() == (is_set_back ? 32 : 31));
}

TEST_CASE("a CARMEN log ends with the ports of which objects were lost", "[recording][carmen]") {
  test::Memory memory;
  CarmenWriter writer(test::to(memory));
  REQUIRE(writer.begin({}).ok());
  REQUIRE(writer.add(kBase, odometry_at(1.0), {}).ok());
  REQUIRE(writer.add(kLaser, scan_at(1.0), {}).ok());
  REQUIRE(writer.close({{kBase, 0}, {kLaser, 3}}, {}).ok());
  const std::string text(reinterpret_cast<const char*>(memory.bytes.data()), memory.bytes.size());
  CHECK_THAT(text, Catch::EndsWith("\n# lost: " + kLaser + " 3\n") && !Contains(kBase));
  CHECK(writer.messages() == 2);
  CHECK(log_of(text).flaws.texts().empty());
}
