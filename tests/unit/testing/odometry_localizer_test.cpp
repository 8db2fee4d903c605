// SPDX-License-Identifier: GPL-3.0-or-later
// Where an OdometryLocalizer says that the robot is.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;

namespace {

constexpr double kRight = std::numbers::pi / 2;

struct Robot final : Partner {
  using Partner::Partner;
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushProxy<idl::RobotPose> pose{*this, "RobotPosePush"};
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

TEST_CASE("odometry that does not say how wrong it is gives a pose that is not exact",
          "[testing][localizer]") {
  const auto covariance = pose_with({})->covariance();
  CHECK(position_deviation(covariance) > 0.05);  // after 2 m
  CHECK(covariance[8] > 0.0);
}

TEST_CASE("the uncertainty of the odometry is turned with the frame", "[testing][localizer]") {
  const auto pose = pose_with({0.04, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.002});
  CHECK(pose->covariance()[0] == Approx(0.01));
  CHECK(pose->covariance()[4] == Approx(0.04));
  CHECK(pose->covariance()[8] == Approx(0.002));
}
