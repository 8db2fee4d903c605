// SPDX-License-Identifier: LGPL-3.0-or-later
#include <optional>
#include <utility>

#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/odometry_trust.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

namespace {

using orca::idl::Odometry;
using orca::idl::RobotPose;

/// A localizer by dead reckoning: the odometry, seen from the frame of the world, in which the robot's start is known. It
/// remembers nothing but a pose that somebody has sent, so one that is started on the way knows as much as one that was there from the
/// start. After the base has
/// started again it does not know where the robot is, and says so with each pose, until somebody sets its start.
class OdometryLocalizer final : public orca::Component {
 public:
  explicit OdometryLocalizer(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    lap_on("odometry");
    return start_place_->empty() ? orca::ok() : find_start();
  }

  // Asks where the place is at which the robot starts.
  orca::Status find_start() {
    if (!places_.connected())
      return start_place_.refuse(orca::fail(orca::Code::failed_precondition,
                                            "nobody says where that place is: connect the port \"places\" to "
                                            "a PlaceServer, or set start_x, start_y "
                                            "and start_yaw instead"));
    auto question = places_.loan();
    question->about() = *start_place_;
    const auto answer = places_.query(std::move(question));
    if (!answer && answer.error().code == orca::Code::not_found) return start_place_.refuse(answer.error());
    if (!answer)
      return orca::fail(answer.error().code,
                        "cannot ask where its start_place is: " + answer.error().message +
                            "; let it come up after the PlaceServer, with start_after");
    const orca::idl::GoalPoint& place = **answer;
    start_ = {place.coordinate().point().x(), place.coordinate().point().y(),
              place.orientation().orientation().yaw()};
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto odometry = odometry_.get_update();
    if (!senders_.accepts(*odometry)) return orca::again();
    if (base_.begins_anew(*odometry)) lose(odometry->origin());
    if (told_) begin_at(*std::exchange(told_, std::nullopt), *odometry);
    auto pose = poses_.loan();
    fill(*odometry, *pose);
    poses_.push(std::move(pose));
    return orca::again();
  }

  void lose(const std::string& base) {
    lost_ = true;
    log_warning("it is not known any more where the robot is: \"" + base +
                "\" has begun anew, and counts its odometry from another place; send where the robot is to "
                "RobotPoseSend, or set start_x, start_y and start_yaw to where its odometry begins");
  }

  // Whoever sets the start knows where the odometry begins.
  orca::Status params_changed() override {
    lost_ = false;
    start_.reset();
    told_.reset();
    return orca::ok();
  }

  // Somebody knows where the robot is now, so it is known where the odometry begins. While nobody wants to know where it is, no odometry is
  // heard: then the robot stands, and is there still when the next one comes.
  orca::Status on_pose(const orca::ObjectPtr<RobotPose>& pose) {
    if (orca::Status valid = orca::check_reading(*pose); !valid.ok()) return valid;
    const auto odometry = odometry_.latest();
    const bool hears = odometry && orca::check_reading(*odometry).ok() &&
                       orca::to_seconds(now() - orca::to_time_point(odometry->creation_time())) < kFresh;
    if (hears)
      begin_at(orca::plane_pose(*pose), *odometry);
    else
      told_ = orca::plane_pose(*pose);
    log_info("the robot is where \"" + pose->origin() + "\" says");
    return orca::ok();
  }

  void begin_at(const orca::Pose2& X_WR, const Odometry& odometry) {
    start_ = X_WR * inverse(orca::plane_pose(odometry));
    lost_ = false;
  }

  void save_state(orca::StateWriter& state) const override { state.write(base_, lost_, start_, told_); }
  orca::Status load_state(orca::StateReader& state) override {
    if (state.tag().version == 1) return state.read(base_, lost_);
    if (state.tag().version == 2) return state.read(base_, lost_, start_);
    return state.read(base_, lost_, start_, told_);
  }
  [[nodiscard]] std::uint32_t state_version() const override { return 3; }
  [[nodiscard]] std::vector<orca::StateTag> accepted_states() const override {
    return {{"orca.OdometryLocalizer", 1}, {"orca.OdometryLocalizer", 2}};
  }

  void fill(const Odometry& odometry, RobotPose& pose) {
    const orca::Pose2 start = start_.value_or(orca::Pose2{*start_x_, *start_y_, *start_yaw_});
    orca::idl::Pose2D X_WO;
    X_WO.x(start.x);
    X_WO.y(start.y);
    X_WO.orientation(start.yaw);
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

  static constexpr double kFresh = 1.0;  // [s] age of odometry that says where the robot is now

  orca::SenderWatch senders_{host()};
  orca::OdometryTrust trust_;
  orca::SenderLife base_;
  bool lost_ = false;
  std::optional<orca::Pose2> start_;  // as somebody has said; nothing: as the parameters say
  std::optional<orca::Pose2> told_;   // where the robot is, since no odometry has come
  orca::SendServer<RobotPose> where_{
      *this,
      "RobotPoseSend",
      &OdometryLocalizer::on_pose,
      {.text = "Where the robot is now, in the frame of the world, from somebody who knows it."}};
  orca::PushProxy<Odometry> odometry_{
      *this, "odometry", {.text = "Odometry of the base, from the robot's start on."}};
  orca::PushServer<RobotPose> poses_{
      *this, "RobotPosePush", {.text = "Pose of the robot in the frame of the world, once per lap."}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::GoalPoint> places_{
      *this,
      "places",
      {.text = "Asked once, before the start, where the place is at which the robot starts: a PlaceServer.",
       .optional = true}};
  orca::Param<std::string> start_place_{
      *this,
      "start_place",
      "",
      {.fixed = true,
       .text = "Place at which the robot starts, by its name, instead of the start that the numbers give."}};
  orca::Param<double> start_x_{
      *this, "start_x", 0.0, {.unit = "m", .text = "Start of the robot in the world."}};
  orca::Param<double> start_y_{
      *this, "start_y", 0.0, {.unit = "m", .text = "Start of the robot in the world."}};
  orca::Param<double> start_yaw_{
      *this, "start_yaw", 0.0, {.unit = "rad", .text = "Direction of the robot's x axis there."}};
};

}  // namespace

ORCA_COMPONENT(OdometryLocalizer, "orca.OdometryLocalizer")
