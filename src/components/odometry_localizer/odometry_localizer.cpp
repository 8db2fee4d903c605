// SPDX-License-Identifier: LGPL-3.0-or-later
#include <utility>

#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/odometry_trust.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/sensing.hpp"

namespace {

using orca::idl::Odometry;
using orca::idl::RobotPose;

/// A localizer by dead reckoning: the odometry, seen from the frame of the world, in which the robot's start is known. It
/// remembers nothing, so one that is started on the way knows as much as one that was there from the start. After the base has begun
/// anew it does not know where the robot is, and says so with each pose, until somebody sets its start.
class OdometryLocalizer final : public orca::Component {
 public:
  explicit OdometryLocalizer(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    lap_on("odometry");
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto odometry = odometry_.get_update();
    if (!senders_.accepts(*odometry)) return orca::again();
    if (base_.begins_anew(*odometry)) lose(odometry->origin());
    auto pose = poses_.loan();
    fill(*odometry, *pose);
    poses_.push(std::move(pose));
    return orca::again();
  }

  void lose(const std::string& base) {
    lost_ = true;
    log_warning("it is not known any more where the robot is: \"" + base +
                "\" has begun anew, and counts its odometry from another place; set start_x, start_y and "
                "start_yaw to "
                "where that is");
  }

  // Whoever sets the start knows where the odometry begins.
  orca::Status params_changed() override {
    lost_ = false;
    return orca::ok();
  }

  void save_state(orca::StateWriter& state) const override { state.write(base_, lost_); }
  orca::Status load_state(orca::StateReader& state) override { return state.read(base_, lost_); }

  void fill(const Odometry& odometry, RobotPose& pose) {
    orca::idl::Pose2D X_WO;
    X_WO.x(*start_x_);
    X_WO.y(*start_y_);
    X_WO.orientation(*start_yaw_);
    orca::idl::Pose2D X_OR;
    X_OR.x(odometry.x());
    X_OR.y(odometry.y());
    X_OR.orientation(odometry.steer_angle());
    X_OR.covariance(trust_.covariance_of(odometry));
    const orca::idl::Pose2D X_WR = orca::compose(X_WO, X_OR);
    pose.x(X_WR.x());
    pose.y(X_WR.y());
    pose.orientation(X_WR.orientation());
    pose.covariance(lost_ ? orca::anywhere() : X_WR.covariance());
    pose.translational_velocity(odometry.translational_velocity());
    pose.sideways_velocity(odometry.sideways_velocity());
    pose.steering_velocity(odometry.steering_velocity());
    pose.stamp(odometry.stamp());
  }

  orca::SenderWatch senders_{host()};
  orca::OdometryTrust trust_;
  orca::SenderLife base_;
  bool lost_ = false;
  orca::PushProxy<Odometry> odometry_{
      *this, "odometry", {.text = "What the base measures, from the robot's start on."}};
  orca::PushServer<RobotPose> poses_{
      *this, "RobotPosePush", {.text = "Pose of the robot in the frame of the world, once per lap."}};
  orca::Param<double> start_x_{
      *this, "start_x", 0.0, {.unit = "m", .text = "Start of the robot in the world."}};
  orca::Param<double> start_y_{
      *this, "start_y", 0.0, {.unit = "m", .text = "Start of the robot in the world."}};
  orca::Param<double> start_yaw_{
      *this, "start_yaw", 0.0, {.unit = "rad", .text = "Direction of the robot's x axis there."}};
};

}  // namespace

ORCA_COMPONENT(OdometryLocalizer, "orca.OdometryLocalizer")
