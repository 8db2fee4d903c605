// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/ros/twin.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/ros/message_type.hpp"

using namespace orca;
using namespace orca::ros;

namespace {

std::string hex(const std::vector<std::byte>& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    char digits[4];
    std::snprintf(digits, sizeof digits, "%s%02x", i > 0 && i % 4 == 0 ? " " : "",
                  std::to_integer<unsigned>(bytes[i]));
    text += digits;
  }
  return text;
}

idl::TimeValue seconds(double time) { return to_time_value(TimePoint(from_seconds(time))); }

double double_at(const std::vector<std::byte>& payload, std::size_t offset) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 8; ++i)
    bits |= std::to_integer<std::uint64_t>(payload[4 + offset + i]) << (8 * i);
  return std::bit_cast<double>(bits);
}

}  // namespace

// The bytes agree with two independent serializers (Fast CDR and Cyclone's) for these values.
TEST_CASE("a laser scan is the LaserScan of ROS 2, byte for byte", "[ros][twin]") {
  Loan<idl::LaserRangeReadings> scan = make_object<idl::LaserRangeReadings>();
  scan->origin("laser");
  scan->stamp(seconds(1.5));
  scan->angle_start(-1.0);
  scan->angle_increment(1.0);
  scan->min_range(0.0);
  scan->max_range(8.0);
  scan->time_increment(0.05);
  scan->ranges({1.0, 2.0, 3.0});
  const auto twin = ros_twin(std::move(scan).seal());
  REQUIRE(twin);
  CHECK(twin->type == "sensor_msgs/msg/LaserScan");
  CHECK(hex(twin->payload) ==
        "00010000 01000000 0065cd1d 06000000 6c617365 72000000 000080bf 0000803f 0000803f cdcc4c3d cdcccc3d "
        "00000000 00000041 03000000 0000803f 00000040 00004040 00000000");
}

TEST_CASE("ranges without an echo are infinite, and those that are too near minus infinity", "[ros][twin]") {
  Loan<idl::LaserRangeReadings> scan = make_object<idl::LaserRangeReadings>();
  scan->min_range(0.1);
  scan->max_range(8.0);
  scan->ranges({8.0, 0.05});
  const std::string bytes = hex(ros_twin(std::move(scan).seal())->payload);
  CHECK_THAT(bytes, Catch::Matchers::EndsWith("02000000 0000807f 000080ff 00000000"));
}

TEST_CASE("odometry is in the frames of its robot, and moves base_link in odom", "[ros][twin]") {
  Loan<idl::Odometry> odometry = make_object<idl::Odometry>();
  odometry->origin("Dewey/base");
  odometry->x(1.0);
  odometry->y(2.0);
  odometry->steer_angle(std::numbers::pi / 2.0);
  const ObjectRef object = std::move(odometry).seal();
  const auto twin = ros_twin(object);
  REQUIRE(twin);
  const std::string text(reinterpret_cast<const char*>(twin->payload.data()), twin->payload.size());
  CHECK(text.find("Dewey/odom") != std::string::npos);
  CHECK(text.find("Dewey/base_link") != std::string::npos);
  FrameTree frames;
  const auto transform = frames.hear(object);
  REQUIRE(transform);
  CHECK(transform->type == "tf2_msgs/msg/TFMessage");
}

TEST_CASE("a pose in the world moves the odometry frame in the map, so that base_link has one parent",
          "[ros][twin]") {
  FrameTree frames;
  Loan<idl::Odometry> odometry = make_object<idl::Odometry>();
  odometry->origin("base");
  odometry->x(1.0);
  (void)frames.hear(std::move(odometry).seal());
  Loan<idl::RobotPose> pose = make_object<idl::RobotPose>();
  pose->origin("localizer");
  pose->x(4.0);
  pose->y(3.0);
  const auto transform = frames.hear(std::move(pose).seal());
  REQUIRE(transform);
  // One transform: count 4, stamp 8, "map" 8, "odom" 9 bytes, then the translation at a multiple of 8.
  CHECK(double_at(transform->payload, 32) == Approx(3.0));
  CHECK(double_at(transform->payload, 40) == Approx(3.0));
}

TEST_CASE("each kind of twin has a described type, and other objects have no twin", "[ros][twin]") {
  for (const ObjectType* const type : object_types()) {
    const auto twin = ros_twin(make_object(*type).seal());
    if (twin) CHECK(standard_message_type(twin->type));
  }
  CHECK(ros_twin(std::move(make_object<idl::Door>()).seal().ref())->type == "geometry_msgs/msg/PoseStamped");
  CHECK(ros_twin(std::move(make_object<idl::Battery>()).seal().ref())->type ==
        "sensor_msgs/msg/BatteryState");
  CHECK(ros_twin(std::move(make_object<idl::LogRecord>()).seal().ref())->type == "rcl_interfaces/msg/Log");
  CHECK_FALSE(ros_twin(std::move(make_object<idl::Arrived>()).seal().ref()));
}
