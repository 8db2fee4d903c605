// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of a recording, as docs/tables.md promises them.
#include <catch2/catch.hpp>

#include <limits>

#include "nasty_object.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/text/object_table.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

constexpr const char* kHeader =
    "stamp,port,creation_time,origin,origin_port,seq,mission,cause.origin,cause.port,cause.seq";

template <class T>
ObjectRef sealed(T value, std::int64_t creation_ns = 1'500'000'000) {
  value.creation_time(idl::TimeValue{});
  value.creation_time().ns(creation_ns);
  value.origin() = "maker";
  value.seq(7);
  return ObjectLoan(make_object<T>(value)).seal();
}

idl::LaserRangeReadings scan(const std::vector<double>& ranges) {
  idl::LaserRangeReadings readings;
  readings.ranges() = ranges;
  return readings;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells{""};
  for (const char c : line.substr(0, line.size() - 1)) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::string cell(const std::string& header, const std::string& row, const std::string& column) {
  const std::vector<std::string> names = split(header);
  const auto at = std::find(names.begin(), names.end(), column);
  REQUIRE(at != names.end());
  return split(row).at(static_cast<std::size_t>(at - names.begin()));
}

}  // namespace

TEST_CASE("a table begins with stamp and port, then come the fields, structs with dots, arrays with brackets",
          "[text][table]") {
  ObjectTable table(TimePoint{});
  table.add_type(object_type<idl::RobotPose>());
  CHECK(table.header() == std::string(kHeader) +
                              ",x,y,orientation,translational_velocity,sideways_velocity,steering_velocity,"
                              "covariance[0],covariance[1],covariance[2],covariance[3],covariance[4],"
                              "covariance[5],covariance[6],covariance[7],covariance[8]\n");
  idl::RobotPose pose;
  pose.x(0.1);
  pose.y(-2.0);
  pose.orientation(std::numeric_limits<double>::infinity());
  pose.steering_velocity(-std::numeric_limits<double>::quiet_NaN());
  pose.stamp().ns(1'250'000'000);
  CHECK(table.row("localizer.RobotPosePush", sealed(pose)) ==
        "1.25,localizer.RobotPosePush,1.5,maker,,7,0,,,0,0.1,-2,inf,0,0,nan,0,0,0,0,0,0,0,0,0\n");
}

TEST_CASE("a sequence has a column per element of the objects seen before, and one for the rest",
          "[text][table]") {
  ObjectTable table(TimePoint{});
  table.add_type(object_type<idl::LaserRangeReadings>());
  table.make_room(sealed(scan({1.0, 2.0})));
  table.make_room(sealed(scan({1.0})));
  const std::string header = table.header();
  CHECK_THAT(header, Contains(",ranges[0],ranges[1],ranges[rest],ranges_uncertainty[rest],min_range"));
  const std::string shorter = table.row("laser.scan", sealed(scan({3.5})));
  CHECK(cell(header, shorter, "ranges[0]") == "3.5");
  CHECK(cell(header, shorter, "ranges[1]").empty());
  const std::string longer = table.row("laser.scan", sealed(scan({3.5, 4.5, 5.5, 0.1})));
  CHECK(cell(header, longer, "ranges[1]") == "4.5");
  CHECK(cell(header, longer, "ranges[rest]") == "5.5 0.1");
}

TEST_CASE("a very long sequence does not get a column for each of its elements", "[text][table]") {
  ObjectTable table(TimePoint{});
  table.add_type(object_type<idl::LaserRangeReadings>());
  const ObjectRef scan_of_many = sealed(scan(std::vector<double>(ObjectTable::kMostElements + 2, 8.0)));
  table.make_room(scan_of_many);
  const std::string header = table.header();
  CHECK_THAT(header, Contains(",ranges[2047],ranges[rest],"));
  CHECK(cell(header, table.row("laser.scan", scan_of_many), "ranges[rest]") == "8 8");
}

TEST_CASE("sequences of structs and structs in structs have a column per number", "[text][table]") {
  ObjectTable table(TimePoint{});
  table.add_type(object_type<idl::SonarRangeReadings>());
  idl::SonarRangeReadings sonar;
  sonar.poses().resize(1);
  sonar.poses()[0].rotation().yaw(0.5);
  sonar.stamps().resize(1);
  sonar.stamps()[0].ns(2'000'000'000);
  table.make_room(sealed(sonar));
  const std::string header = table.header();
  const std::string row = table.row("base.sonar", sealed(sonar));
  CHECK(cell(header, row, "poses[0].rotation.yaw") == "0.5");
  CHECK(cell(header, row, "poses[0].x") == "0");
  CHECK(cell(header, row, "stamps[0]") == "2");
  CHECK(cell(header, row, "pose.x") == "0");
}

TEST_CASE("the table of a type has the columns of all types derived from it", "[text][table]") {
  ObjectTable table(TimePoint{});
  table.add_type(object_type<idl::GoalPoint>());
  const std::string header = table.header();
  CHECK_THAT(header, Contains(",coordinate.x,") && Contains(",leaf_angle.orientation,"));
  idl::Door door;
  door.name("front");
  door.leaf_angle().orientation(0.25);
  CHECK(cell(header, table.row("goto.goal", sealed(door)), "leaf_angle.orientation") == "0.25");
  CHECK(cell(header, table.row("goto.goal", sealed(idl::GoalPoint{})), "leaf_angle.orientation").empty());
}

TEST_CASE("types of several kinds share the columns of their common names", "[text][table]") {
  ObjectTable table(TimePoint{});
  table.add_type(object_type<idl::RobotPose>());
  table.add_type(object_type<idl::Odometry>());
  const std::string header = table.header();
  CHECK(header.find(",x,") == header.rfind(",x,"));
  CHECK_THAT(header, Contains(",orientation,") && Contains(",steer_angle"));
  idl::Odometry odometry;
  odometry.x(3.0);
  const std::string row = table.row("base.OdometryPush", sealed(odometry));
  CHECK(cell(header, row, "x") == "3");
  CHECK(cell(header, row, "orientation").empty());
}

TEST_CASE("a field that is itself called port gets an underscore", "[text][table]") {
  ObjectTable table(TimePoint{});
  table.add_type(object_type<idl::Sensor>());
  CHECK_THAT(table.header(), StartsWith(std::string(kHeader)) && Contains(",port_,"));
}

TEST_CASE("instants count from the start of the run; one that was never set is empty", "[text][table]") {
  ObjectTable table(TimePoint(std::chrono::seconds(1000)));
  table.add_type(object_type<idl::RobotPose>());
  const std::string header = table.header();
  const std::string row = table.row("a.b", sealed(idl::RobotPose{}, 1'000'250'000'001));
  CHECK(cell(header, row, "creation_time") == "0.250000001");
  CHECK(cell(header, row, "stamp").empty());
}

TEST_CASE("whatever objects contain, each is one line with one cell per column", "[text][table]") {
  ObjectTable table(TimePoint{});
  table.add_type(object_type<idl::Sensor>());
  const std::string header = table.header();
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::string row = table.row("a.b", ObjectLoan(make_object(nasty_object<idl::Sensor>(seed))).seal());
    std::size_t cells = 1;
    bool quoted = false;
    for (const char c : row) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) ++cells;
    }
    CAPTURE(row);
    CHECK(cells == split(header).size());
    CHECK(row.find('\n') == row.size() - 1);
    CHECK(row.find('\r') == std::string::npos);
  }
}

TEST_CASE("an enumeration and a field that is true or false say which words they can be, others do not",
          "[text]") {
  const idl::MotionCommand command;
  const ObjectType& type = object_type<idl::MotionCommand>();
  CHECK(field_words(type, &command, "kind") == std::vector<std::string>{"NORMAL", "DONTCARE", "FULLSTOP"});
  CHECK(field_words(type, &command, "speed").empty());
  CHECK(field_words(type, &command, "kin").empty());
  const idl::GoalPoint goal;
  CHECK(field_words(object_type<idl::GoalPoint>(), &goal, "use_orientation") ==
        std::vector<std::string>{"true", "false"});
}
