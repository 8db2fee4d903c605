// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mates.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/machines.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/pose_history.hpp"
#include "orca/planning/asked_robot.hpp"

namespace {

using orca::idl::MovingThings;
using orca::idl::Teammate;

constexpr orca::Duration kInterval{std::chrono::milliseconds(50)};  // between two words of this robot

// Whoever is in the network can say anything.
orca::Status check_mate(const Teammate& mate) {
  constexpr double kLargest = 10.0;  // [m]
  if (orca::Status checked = orca::check_reading(mate); !checked.ok()) return checked;
  if (!orca::may_be_system(mate.name())) return orca::fail(orca::Code::data_loss, "its name is none");
  if (mate.hears().size() > orca::team::Mates::kMost)
    return orca::fail(orca::Code::data_loss, "it names more robots than there may be");
  if (mate.radius() >= 0.0 && mate.radius() <= kLargest) return orca::ok();
  return orca::fail(orca::Code::data_loss,
                    "radius is " + std::to_string(mate.radius()) + "; expected 0 to 10 m");
}

/// Tells the other robots of a team where this one is, and makes of what they say who moves near it. See README.md.
class Teammates final : public orca::Component {
 public:
  explicit Teammates(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status params_changed() override {
    if (orca::may_be_system(*name_)) return orca::ok();
    return name_.refuse("a robot of a team has a name: letters, digits, '_' and '/', at most 64 of them");
  }

  orca::Status configure() override {
    lap_on(odometry_);
    return orca::ok();
  }

  orca::Status start() override {
    forget_places();
    mates_.clear();
    sources_.clear();
    return robot_.ask();
  }

  void stop() override {
    others_.unsubscribe_all();
    robot_.leave();
  }

  orca::Outcome work() override {
    learn_robot();
    hear_others();
    while (odometry_.new_data_arrived()) follow(*odometry_.get_update());
    if (localizer_.new_data_arrived()) pose_ = localizer_.get_update();
    if (!history_.empty()) {
      locate();
      tell_others();
      push_moving();
    }
    return orca::again();
  }

  void learn_robot() {
    if (const orca::Status learnt = robot_.learn(); !learnt.ok())
      log_warning(learnt.error().text() + "; the others are told the parameter radius");
    else if (robot_.body())
      own_radius_ = robot_.body()->radius;
  }

  void hear_others() {
    for (const auto& source : others_.sources()) {
      if (std::ranges::find(sources_, source) == sources_.end()) {
        source.subscribe();
        sources_.push_back(source);
      }
      while (const auto mate = source.take())
        if (senders_.accepts(check_mate(*mate), "Teammate", mate->origin())) hear(*mate);
    }
    mates_.forget(now(), orca::from_seconds(*lost_after_));
  }

  void hear(const Teammate& mate) {
    if (mate.name() == *name_ && !std::exchange(is_name_taken_, true))
      log_warning("another robot of the team is called " + *name_ + ", too; give one of them another name");
    mates_.hear(mate, now());
  }

  void forget_places() {
    history_.clear();
    pose_ = nullptr;
    here_.reset();
  }

  void follow(const orca::idl::Odometry& odometry) {
    if (!senders_.accepts(odometry)) return;
    if (odometer_.begins_anew(odometry)) forget_places();  // all lies elsewhere now
    history_.add(orca::to_time_point(odometry.stamp()), orca::plane_pose(odometry));
  }

  // Finds where the map is in the frame of the odometry. A pose waits for the odometry of its instant.
  void locate() {
    if (!pose_ || !senders_.accepts(*pose_)) return;
    if (orca::is_anywhere(pose_->covariance())) return here_.reset();
    const auto X_OR = history_.at(orca::to_time_point(pose_->stamp()));
    if (!X_OR) return;
    here_ = {*name_, *map_, *X_OR * inverse(orca::plane_pose(*pose_)),
             orca::position_deviation(pose_->covariance())};
  }

  void tell_others() {
    if (!pose_ || !here_ || pose_ == told_ || (told_at_ && now() - *told_at_ < kInterval)) return;
    told_ = pose_;
    told_at_ = now();
    auto mate = mate_.loan();
    mate->name(*name_);
    mate->map_name(*map_);
    orca::idl::Pose2D& there = mate->pose();
    there.x(pose_->x());
    there.y(pose_->y());
    there.orientation(pose_->orientation());
    there.stamp(pose_->stamp());
    there.covariance(pose_->covariance());
    mate->translational_velocity(pose_->translational_velocity());
    mate->sideways_velocity(pose_->sideways_velocity());
    mate->radius(own_radius_.value_or(*radius_));
    mate->hears(mates_.names());
    mate_.push(std::move(mate));
  }

  void push_moving() {
    const auto seen = seen_.latest();
    if (seen_.connected() && !seen) return;  // nobody has looked yet
    auto moving = moving_.loan();
    moving->things().clear();
    if (seen) moving->things() = seen->things();
    moving->stamp(seen ? seen->stamp() : orca::to_time_value(history_.newest()));
    if (here_) mates_.add(*here_, orca::to_time_point(moving->stamp()), *moving);
    moving_.push(std::move(moving));
  }

  orca::PushProxy<orca::idl::Odometry> odometry_{
      *this, "odometry", {.text = "Motion of the robot.", .depth = 16}};
  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot in the map that the team shares."}};
  orca::PushProxyArray<Teammate> others_{
      *this,
      "others",
      {.text = "What other robots of the team say of themselves.", .optional = true, .depth = 16}};
  orca::PushProxy<MovingThings> seen_{
      *this,
      "seen",
      {.text = "Who else moves near the robot, by its own sensors; goes on to MovingThingsPush.",
       .optional = true}};
  orca::planning::AskedRobot robot_{*this, "Base that is asked how large the robot is."};
  orca::PushServer<Teammate> mate_{
      *this, "TeammatePush", {.text = "What this robot says of itself, at most twenty times a second."}};
  orca::PushServer<MovingThings> moving_{*this,
                                         "MovingThingsPush",
                                         {.text = "The other robots that this one lets pass, and whoever "
                                                  "else is seen, in the frame of the odometry."}};

  orca::Param<std::string> name_{
      *this, "name", "", {.text = "Name of the robot; no other one of the team has it."}};
  orca::Param<std::string> map_{
      *this,
      "map",
      "",
      {.text = "Name of the map in which its pose is; robots of other maps are not noticed."}};
  orca::Param<double> radius_{
      *this,
      "radius",
      0.3,
      {.unit = "m",
       .min = 0.0,
       .max = 10.0,
       .text = "Radius of the circle that holds the robot, unless the base says it."}};
  orca::Param<double> lost_after_{
      *this,
      "lost_after",
      1.0,
      {.unit = "s", .min = 0.2, .max = 60.0, .text = "Time after which a robot that says nothing is gone."}};

  orca::team::Mates mates_;
  std::vector<orca::PushProxyArray<Teammate>::Source> sources_;
  orca::SenderWatch senders_{host()};
  orca::SenderLife odometer_;
  orca::nav::PoseHistory history_;  // in the frame of the odometry
  orca::ObjectPtr<orca::idl::RobotPose> pose_;
  std::optional<orca::team::Mates::Here> here_;  // nothing: the robot does not know where it is
  orca::ObjectPtr<orca::idl::RobotPose> told_;
  std::optional<orca::TimePoint> told_at_;
  std::optional<double> own_radius_;
  bool is_name_taken_ = false;  // and that is reported
};

}  // namespace

ORCA_COMPONENT(Teammates, "orca.Teammates")
