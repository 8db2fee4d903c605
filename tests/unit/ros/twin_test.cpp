// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/ros/twin.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "hex.hpp"
#include "orca/idl/checks.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/frame_tree.hpp"
#include "orca/ros/message_type.hpp"
#include "orca/ros/range_ring.hpp"

using namespace orca;
using namespace orca::ros;
using orca::test::hex;

namespace {

idl::TimeValue seconds(double time) { return to_time_value(TimePoint(from_seconds(time))); }

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
  nav_msgs::Odometry message;
  REQUIRE(from_cdr(twin->payload, message).ok());
  CHECK(message.header.frame_id == "Dewey/odom");
  CHECK(message.child_frame_id == "Dewey/base_link");
  FrameTree frames;
  const auto news = frames.hear(object);
  REQUIRE(news);
  CHECK_FALSE(news->is_static);
  REQUIRE(news->message.transforms.size() == 1);
  const geometry_msgs::TransformStamped& said = news->message.transforms.front();
  CHECK(said.header.frame_id == "Dewey/odom");
  CHECK(said.child_frame_id == "Dewey/base_link");
  CHECK(said.transform.translation == geometry_msgs::Vector3{1.0, 2.0, 0.0});
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
  const auto news = frames.hear(std::move(pose).seal());
  REQUIRE(news);
  const geometry_msgs::TransformStamped& said = news->message.transforms.front();
  CHECK(said.header.frame_id == "map");
  CHECK(said.child_frame_id == "odom");
  CHECK(said.transform.translation.x == Approx(3.0));
  CHECK(said.transform.translation.y == Approx(3.0));
}

TEST_CASE("where others say how the robot moves in odom, a pose moves odom in the map as well",
          "[ros][twin]") {
  FrameTree frames;
  frames.learn({{{{{}, "odom"}, "base_link", {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}}}});
  Loan<idl::RobotPose> pose = make_object<idl::RobotPose>();
  pose->x(4.0);
  const auto news = frames.hear(std::move(pose).seal());
  REQUIRE(news);
  CHECK(news->message.transforms.front().child_frame_id == "odom");
  CHECK(news->message.transforms.front().transform.translation.x == Approx(3.0));
}

TEST_CASE("a sensor's place is found over several frames, and not where they do not hang together",
          "[ros][twin]") {
  FrameTree frames;
  const double half = std::sqrt(0.5);  // a quarter turn to the left
  frames.learn({{{{{}, "base_link"}, "shell", {{0.1, 0.0, 0.2}, {0.0, 0.0, half, half}}},
                 {{{}, "shell"}, "laser", {{0.05, 0.0, 0.03}, {0.0, 0.0, 0.0, 1.0}}},
                 {{{}, "a"}, "b", {}},
                 {{{}, "b"}, "a", {}}}});
  const auto place = frames.mount_of("laser");
  REQUIRE(place);
  CHECK(place->position().x() == Approx(0.1));
  CHECK(place->position().y() == Approx(0.05));
  CHECK(place->position().z() == Approx(0.23));
  CHECK(place->rotation().yaw() == Approx(std::numbers::pi / 2.0));
  CHECK_FALSE(frames.mount_of("camera"));
  CHECK_FALSE(frames.mount_of("a"));
}

TEST_CASE("a ring of sonars is a Range for each, in frames of their own", "[ros][twin]") {
  Loan<idl::SonarRangeReadings> ring = make_object<idl::SonarRangeReadings>();
  ring->origin("base");
  ring->min_range(0.1);
  ring->max_range(3.0);
  ring->half_lobe(0.2);
  ring->ranges({1.5, 3.0});
  ring->poses({make_frame(make_point(0.1, 0.1, 0.2), 1.0), make_frame(make_point(0.1, -0.1, 0.2), -1.0)});
  const ObjectRef object = std::move(ring).seal();
  CHECK_FALSE(ros_twin(object));  // viewers get the ring itself
  const Twin* const twin = twin_to_ros(object.type());
  REQUIRE(twin != nullptr);
  std::vector<std::vector<std::byte>> payloads;
  twin->to_ros(object, payloads);
  REQUIRE(payloads.size() == 2);
  sensor_msgs::Range second;
  REQUIRE(from_cdr(payloads[1], second).ok());
  CHECK(second.header.frame_id == "base_1");
  CHECK(second.field_of_view == 0.4F);
  CHECK(std::isinf(second.range));
  CHECK_FALSE(FrameTree().hear(object));  // nor do they get all mounts with each round
  const auto news = mounts_of_ring(object);
  REQUIRE(news);
  CHECK(news->is_static);
  CHECK(news->message.transforms[1].child_frame_id == "base_1");
}

TEST_CASE("a Twist is a motion command, and one that slides a HolonomicVelocity", "[ros][twin]") {
  const Twin* const twin = twin_from_ros(object_type<idl::MotionCommand>());
  REQUIRE(twin != nullptr);
  CHECK(twin->message == "geometry_msgs/msg/Twist");
  const Result<ObjectRef> ahead =
      twin->from_ros(to_cdr(geometry_msgs::Twist{{0.25, 0.0, 0.0}, {0.0, 0.0, -0.5}}), {}, {});
  REQUIRE(ahead);
  const auto command = object_cast<idl::MotionCommand>(*ahead);
  CHECK(command->steering() == idl::BY_TURN_RATE);
  CHECK(command->speed() == 0.25);
  CHECK(command->turn_rate() == -0.5);
  CHECK_FALSE(command.as<idl::HolonomicVelocity>());
  const Result<ObjectRef> aside = twin->from_ros(to_cdr(geometry_msgs::Twist{{0.0, 0.1, 0.0}, {}}), {}, {});
  REQUIRE(aside);
  CHECK(object_cast<idl::HolonomicVelocity>(*aside)->left() == 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(twin->from_ros(to_cdr(geometry_msgs::Twist{{nan, 0.0, 0.0}, {}}), {}, {}));
}

TEST_CASE("a command is a Twist: a direction is a turn, a full stop is zero, no opinion is no message",
          "[ros][twin]") {
  const auto sent = [](const ObjectRef& object) {
    std::vector<std::vector<std::byte>> payloads;
    twin_to_ros(object.type())->to_ros(object, payloads);
    std::vector<geometry_msgs::Twist> twists(payloads.size());
    for (std::size_t i = 0; i < twists.size(); ++i) REQUIRE(from_cdr(payloads[i], twists[i]).ok());
    return twists;
  };
  CHECK(sent(turn(0.3, 0.2).operator ObjectPtr<idl::MotionCommand>()) ==
        std::vector{geometry_msgs::Twist{{0.2, 0.0, 0.0}, {0.0, 0.0, 0.3}}});
  const auto aside = sent(head(std::numbers::pi / 2.0, 0.2).operator ObjectPtr<idl::MotionCommand>());
  REQUIRE(aside.size() == 1);
  CHECK(aside[0].linear.x == Approx(0.0).margin(1e-9));
  CHECK(aside[0].angular.z == 1.0);
  CHECK(sent(full_stop().operator ObjectPtr<idl::MotionCommand>()) == std::vector{geometry_msgs::Twist{}});
  CHECK(sent(dont_care().operator ObjectPtr<idl::MotionCommand>()).empty());
  CHECK(sent(slide(0.2, 0.1, 0.3).operator ObjectPtr<idl::HolonomicVelocity>()) ==
        std::vector{geometry_msgs::Twist{{0.2, 0.1, 0.0}, {0.0, 0.0, 0.3}}});
}

TEST_CASE("a laser's 0 and NaN mean that nothing came back, as +inf does", "[ros][twin]") {
  sensor_msgs::LaserScan message;
  message.range_min = 0.5F;
  message.range_max = 8.0F;
  const float inf = std::numeric_limits<float>::infinity();
  message.ranges = {1.0F, 0.0F, std::nanf(""), inf, -inf, 9.0F};
  const Result<ObjectRef> object =
      twin_from_ros(object_type<idl::LaserRangeReadings>())->from_ros(to_cdr(message), {}, {});
  REQUIRE(object);
  CHECK(object_cast<idl::LaserRangeReadings>(*object)->ranges() ==
        std::vector<double>{1.0, 8.0, 8.0, 8.0, 0.25, 8.0});
}

// An object for every twin that goes both ways, with something in its fields; angles are 0, which come back exactly.
std::vector<ObjectRef> examples() {
  std::vector<ObjectRef> all;
  Loan<idl::LaserRangeReadings> scan = make_object<idl::LaserRangeReadings>();
  scan->stamp(seconds(1.5));
  scan->angle_start(-1.0);
  scan->angle_increment(0.5);
  scan->max_range(8.0);
  scan->ranges({1.0, 8.0, 2.5});
  all.push_back(std::move(scan).seal());
  Loan<idl::SonarRangeReadings> sonar = make_object<idl::SonarRangeReadings>();
  sonar->max_range(3.0);
  sonar->half_lobe(0.25);
  sonar->ranges({1.5});
  all.push_back(std::move(sonar).seal());
  Loan<idl::InfraredRangeReadings> infrared = make_object<idl::InfraredRangeReadings>();
  infrared->max_range(0.5);
  infrared->ranges({0.25});
  all.push_back(std::move(infrared).seal());
  Loan<idl::Odometry> odometry = make_object<idl::Odometry>();
  odometry->x(-3.5);
  odometry->sideways_velocity(0.1);
  odometry->covariance({1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0});
  all.push_back(std::move(odometry).seal());
  Loan<idl::Image> image = make_object<idl::Image>();
  image->encoding(idl::RGB8);
  image->width(1);
  image->height(2);
  image->step(3);
  image->data({1, 2, 3, 4, 5, 6});
  all.push_back(std::move(image).seal());
  Loan<idl::Battery> battery = make_object<idl::Battery>();
  battery->name("drive");
  battery->voltage(12.5);
  battery->charging(true);
  all.push_back(std::move(battery).seal());
  all.push_back(std::move(turn(0.25, 0.5)).seal());
  all.push_back(std::move(slide(0.25, -0.5, 0.125)).seal());
  Loan<idl::RobotPose> pose = make_object<idl::RobotPose>();
  pose->x(2.0);
  all.push_back(std::move(pose).seal());
  Loan<idl::GoalPoint> goal = make_object<idl::GoalPoint>();
  goal->coordinate().point(make_point(1.0, 2.0, 0.0));
  goal->use_orientation(true);
  all.push_back(std::move(goal).seal());
  Loan<idl::Path> path = make_object<idl::Path>();
  path->poses().resize(2);
  path->poses()[1].position(make_point(1.0, -1.0, 0.0));
  all.push_back(std::move(path).seal());
  Loan<idl::OccupancyGrid> grid = make_object<idl::OccupancyGrid>();
  grid->resolution(0.5);
  grid->columns(3);
  grid->rows(1);
  grid->cells({255, 0, 100});
  all.push_back(std::move(grid).seal());
  return all;
}

TEST_CASE("what an object says to ROS comes back as an object that says the same", "[ros][twin]") {
  std::set<const ObjectType*> tried;
  for (const ObjectRef& object : examples()) {
    for (const Twin& twin : twins()) {
      if (&twin.object != &object.type() || twin.from_ros == nullptr || twin.to_ros == nullptr) continue;
      CAPTURE(twin.object.name, twin.message);
      std::vector<std::vector<std::byte>> payloads;
      twin.to_ros(object, payloads);
      REQUIRE(payloads.size() == 1);
      const Result<ObjectRef> back = twin.from_ros(payloads.front(), {}, {});
      REQUIRE(back);
      CHECK(&back->type() == &object.type());
      std::vector<std::vector<std::byte>> again;
      twin.to_ros(*back, again);
      CHECK(again == payloads);
      tried.insert(&twin.object);
    }
  }
  for (const Twin& twin : twins()) {
    CAPTURE(twin.object.name);
    if (twin.from_ros != nullptr && twin.to_ros != nullptr) CHECK(tried.contains(&twin.object));
  }
}

TEST_CASE("angles come back, also those near a half turn", "[ros][twin]") {
  for (const double yaw : {-3.1, -1.0, 0.5, 3.0}) {
    CAPTURE(yaw);
    Loan<idl::Odometry> odometry = make_object<idl::Odometry>();
    odometry->steer_angle(yaw);
    const auto message = ros_twin(std::move(odometry).seal());
    REQUIRE(message);
    const auto back = twin_from_ros(object_type<idl::Odometry>())->from_ros(message->payload, {}, {});
    REQUIRE(back);
    CHECK(object_cast<idl::Odometry>(*back)->steer_angle() == Approx(yaw));
  }
}

TEST_CASE("a camera's images are in its optical frame, and a camera of ROS looks where its frame says",
          "[ros][twin]") {
  Loan<idl::Image> image = make_object<idl::Image>();
  image->origin("camera");
  image->pose().position(make_point(0.2, 0.0, 0.5));  // looking ahead
  const ObjectRef object = std::move(image).seal();
  FrameTree frames;
  const auto news = frames.hear(object);
  REQUIRE(news);
  const geometry_msgs::TransformStamped& said = news->message.transforms.front();
  CHECK(said.child_frame_id == "camera_optical");
  // Its z axis is the robot's x axis, its x axis the robot's right.
  CHECK(said.transform.rotation.x == Approx(-0.5));
  CHECK(said.transform.rotation.y == Approx(0.5));
  CHECK(said.transform.rotation.z == Approx(-0.5));
  CHECK(said.transform.rotation.w == Approx(0.5));
  FrameTree others;
  others.learn(news->message);
  const auto mount_of = [&](const std::string& frame) { return others.mount_of(frame); };
  const auto message = ros_twin(object);
  REQUIRE(message);
  const auto back = twin_from_ros(object_type<idl::Image>())->from_ros(message->payload, mount_of, {});
  REQUIRE(back);
  const auto seen = object_cast<idl::Image>(*back);
  CHECK(seen->origin() == "camera");
  CHECK(seen->pose().position().x() == Approx(0.2));
  CHECK(seen->pose().rotation().roll() == Approx(0.0).margin(1e-9));
  CHECK(seen->pose().rotation().pitch() == Approx(0.0).margin(1e-9));
  CHECK(seen->pose().rotation().yaw() == Approx(0.0).margin(1e-9));
}

TEST_CASE("a laser of others that hangs upside down is heard as one that stands upright", "[ros][twin]") {
  sensor_msgs::LaserScan message;
  message.header.frame_id = "laser";
  message.angle_min = -1.0F;
  message.angle_increment = 0.5F;
  message.range_min = 0.1F;
  message.range_max = 10.0F;
  message.ranges = {1.0F, 2.0F, 3.0F};
  const auto mount_of = [](const std::string&) {
    idl::Frame3D place;
    place.rotation().roll(std::numbers::pi - 0.1);
    place.rotation().yaw(0.3);
    return std::optional(place);
  };
  const auto heard =
      twin_from_ros(object_type<idl::LaserRangeReadings>())->from_ros(to_cdr(message), mount_of, {});
  REQUIRE(heard);
  const auto scan = object_cast<idl::LaserRangeReadings>(*heard);
  CHECK(check_reading(*scan).ok());
  CHECK(scan->angle_start() == 1.0);
  CHECK(scan->angle_increment() == -0.5);
  CHECK(scan->ranges() == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(scan->pose().rotation().roll() == Approx(-0.1));
  CHECK(scan->pose().rotation().yaw() == 0.3);
}

TEST_CASE("a goal in another frame than the map's is refused", "[ros][twin]") {
  const Twin* const twin = twin_from_ros(object_type<idl::GoalPoint>());
  geometry_msgs::PoseStamped goal;
  for (const char* const frame : {"map", "", "Dewey/map"}) {
    goal.header.frame_id = frame;
    CHECK(twin->from_ros(to_cdr(goal), {}, {}));
  }
  for (const char* const frame : {"odom", "base_link", "treasure_map"}) {
    goal.header.frame_id = frame;
    const auto refused = twin->from_ros(to_cdr(goal), {}, {});
    REQUIRE_FALSE(refused);
    CHECK_THAT(refused.error().message, Catch::Matchers::Contains(frame));
  }
}

TEST_CASE("what has no stamp, or one of the future, is as old as its arrival", "[ros][twin]") {
  const TimePoint came(from_seconds(100.0));
  const Twin* const scans = twin_from_ros(object_type<idl::LaserRangeReadings>());
  sensor_msgs::LaserScan scan;
  CHECK(scans->from_ros(to_cdr(scan), {}, came)->stamp() == came);
  const Twin* const twists =
      twin_from_ros(object_type<idl::MotionCommand>(), "geometry_msgs/msg/TwistStamped");
  geometry_msgs::TwistStamped command;
  command.header.stamp.sec = 110;
  CHECK(to_time_point(twists->from_ros(to_cdr(command), {}, came)->header().creation_time()) == came);
}

TEST_CASE("readings of a ring that come one by one are a ring again; a sensor that falls silent leaves it",
          "[ros][twin]") {
  RangeRing ring;
  const auto hear = [&](const char* frame, float range, std::int32_t seconds) {
    const sensor_msgs::Range message{{{seconds, 0}, frame}, 0, 0.4F, 0.1F, 3.0F, range, 0.0F};
    const auto reading =
        twin_from_ros(object_type<idl::SonarRangeReadings>())->from_ros(to_cdr(message), {}, {});
    REQUIRE(reading);
    return object_cast<idl::SonarRangeReadings>(ring.take(*reading));
  };
  CHECK(hear("sonar_0", 1.0F, 10)->ranges() == std::vector<double>{1.0});
  CHECK(hear("sonar_1", 2.0F, 10)->ranges() == std::vector<double>{1.0, 2.0});
  CHECK(hear("sonar_0", 1.5F, 11)->ranges() == std::vector<double>{1.5, 2.0});
  CHECK(hear("sonar_0", 1.5F, 14)->ranges() == std::vector<double>{1.5});
  CHECK(hear("sonar_2", 0.0F, 14)->ranges().back() == Approx(0.05));  // it is touched
}

TEST_CASE("frames of others that only sound alike are not the robot's", "[ros][twin]") {
  FrameTree frames;
  frames.learn({{{{{}, "arm_base_link"}, "tool", {{0.1, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}},
                 {{{}, "visual_odom"}, "base_link", {{5.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}}}});
  CHECK_FALSE(frames.mount_of("tool"));
  Loan<idl::RobotPose> pose = make_object<idl::RobotPose>();
  CHECK_FALSE(frames.hear(std::move(pose).seal()));  // base_link has a parent already
}

TEST_CASE("a pose moves odom by the odometry of its own instant, over a frame between odom and base_link",
          "[ros][twin]") {
  FrameTree frames;
  const auto moved = [](std::int32_t seconds, double x) {
    return tf2_msgs::TFMessage{
        {{{{seconds, 0}, "odom"}, "base_footprint", {{x, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}}}};
  };
  frames.learn({{{{{}, "base_footprint"}, "base_link", {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.0, 1.0}}}}});
  frames.learn(moved(1, 1.0));
  frames.learn(moved(2, 2.0));
  Loan<idl::RobotPose> pose = make_object<idl::RobotPose>();
  pose->stamp(seconds(1.1));
  pose->x(4.0);
  const auto news = frames.hear(std::move(pose).seal());
  REQUIRE(news);
  CHECK(news->message.transforms.front().child_frame_id == "odom");
  CHECK(news->message.transforms.front().transform.translation.x == Approx(3.0));
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
