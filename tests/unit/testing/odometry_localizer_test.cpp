// SPDX-License-Identifier: GPL-3.0-or-later
// Where an OdometryLocalizer says that the robot is.
#include <catch2/catch.hpp>

#include <chrono>
#include <numbers>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

constexpr double kRight = std::numbers::pi / 2;

struct Robot final : Partner {
  using Partner::Partner;
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushProxy<idl::RobotPose> pose{*this, "RobotPosePush"};
  SendProxy<idl::RobotPose> where{*this, "RobotPoseSend"};
};

// Returns the pose of a robot that started at (1, 6), facing left, and has driven 2 m ahead and 0.5 m to the left.
ObjectPtr<idl::RobotPose> pose_with(const std::array<double, 9>& covariance) {
  ObjectPtr<idl::RobotPose> pose;
  const Trial trial{.type = "orca.OdometryLocalizer",
                    .params = {{"start_x", "1 m"}, {"start_y", "6 m"}, {"start_yaw", "90 deg"}}};
  try_component<Robot>(trial, [&](Robot& robot) {
    auto odometry = robot.odometry.loan();
    odometry->x(2.0);
    odometry->y(0.5);
    odometry->steer_angle(0.25);
    odometry->translational_velocity(0.4);
    odometry->steering_velocity(-0.1);
    odometry->stamp().ns(123);
    odometry->covariance(covariance);
    robot.odometry.push(std::move(odometry));
    pose = robot.pose.get_update_wait();
  });
  return pose;
}

}  // namespace

TEST_CASE("a pose by odometry starts where the robot does, and faces as it did", "[testing][localizer]") {
  const auto pose = pose_with({});
  CHECK(pose->x() == Approx(1.0 - 0.5));
  CHECK(pose->y() == Approx(6.0 + 2.0));
  CHECK(pose->orientation() == Approx(kRight + 0.25));
  CHECK(pose->translational_velocity() == 0.4);
  CHECK(pose->steering_velocity() == -0.1);
  CHECK(pose->stamp().ns() == 123);
}

TEST_CASE(
    "odometry that knows its orientation only, after some metres, does not know where the robot is exactly",
    "[testing][localizer]") {
  const double unknown = position_deviation(pose_with({})->covariance());
  CHECK(unknown > 0.01);
  CHECK(position_deviation(pose_with({0, 0, 0, 0, 0, 0, 0, 0, 0.01})->covariance()) == unknown);
  CHECK(position_deviation(pose_with({1e-4, 0, 0, 0, 0, 0, 0, 0, 0.01})->covariance()) == Approx(0.01));
}

TEST_CASE("whoever sends where the robot is now decides all poses that follow", "[testing][localizer]") {
  Pose2 there{};
  Pose2 later{};
  try_component<Robot>({.type = "orca.OdometryLocalizer"}, [&](Robot& robot) {
    const auto drive_to = [&](double x, double y, double yaw) {
      auto odometry = robot.odometry.loan();
      odometry->x(x);
      odometry->y(y);
      odometry->steer_angle(yaw);
      robot.odometry.push(std::move(odometry));
      return plane_pose(*robot.pose.get_update_wait());
    };
    drive_to(2.0, 0.5, 0.25);
    auto where = make_object<idl::RobotPose>();
    where->x(7.0);
    where->y(-3.0);
    where->orientation(0.25 + kRight);
    REQUIRE(robot.where.send(std::move(where)).ok());
    robot.sleep(10ms);
    there = drive_to(2.0, 0.5, 0.25);
    later = drive_to(3.0, 0.5, 0.25);
  });
  CHECK(there.x == Approx(7.0));
  CHECK(there.y == Approx(-3.0));
  CHECK(there.yaw == Approx(0.25 + kRight));
  CHECK(later.x == Approx(7.0));
  CHECK(later.y == Approx(-2.0));
}

TEST_CASE("where a robot is that nobody has asked for yet counts from the first odometry on",
          "[testing][localizer]") {
  Pose2 first{};
  try_component<Robot>({.type = "orca.OdometryLocalizer"}, [&](Robot& robot) {
    auto where = make_object<idl::RobotPose>();
    where->x(7.0);
    where->y(-3.0);
    where->orientation(kRight);
    REQUIRE(robot.where.send(std::move(where)).ok());
    robot.sleep(5s);
    auto odometry = robot.odometry.loan();
    odometry->x(2.0);
    odometry->stamp(to_time_value(robot.now()));
    robot.odometry.push(std::move(odometry));
    first = plane_pose(*robot.pose.get_update_wait());
  });
  CHECK(first.x == Approx(7.0));
  CHECK(first.y == Approx(-3.0));
  CHECK(first.yaw == Approx(kRight));
}

TEST_CASE("odometry that does not say how wrong it is gives a pose that is not exact",
          "[testing][localizer]") {
  const auto covariance = pose_with({})->covariance();
  CHECK(position_deviation(covariance) > 0.01);  // after 2 m
  CHECK(covariance[8] > 0.0);
}

TEST_CASE("the uncertainty of the odometry is turned with the frame", "[testing][localizer]") {
  const auto pose = pose_with({0.04, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.002});
  CHECK(pose->covariance()[0] == Approx(0.01));
  CHECK(pose->covariance()[4] == Approx(0.04));
  CHECK(pose->covariance()[8] == Approx(0.002));
}
