// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/planning/asked_robot.hpp"
#include "orca/planning/ways.hpp"
#include "passage.hpp"

namespace {

using orca::Pose2;
using orca::Vec2;
using orca::doors::Gap;
using orca::doors::Step;
using orca::idl::Door;

/// A behaviour that takes a robot through a doorway (thesis 2.3: traverse-door): it lines up, waits for an open door, and passes in the middle of
/// the gap that its laser sees. See README.md.
class TraverseDoor final : public orca::Component {
 public:
  explicit TraverseDoor(orca::ComponentHost& host) : Component(host) { lap_on("localizer"); }

 private:
  orca::Status configure() override { return robot_.check(); }

  orca::Status start() override {
    motion_.start(lap_period());
    passage_.reset();
    return robot_.ask();
  }
  void stop() override { robot_.leave(); }

  orca::Outcome work() override {
    if (const orca::Status learnt = robot_.learn(); !learnt.ok()) return orca::failed(learnt.error().text());
    const auto pose = localizer_.get_update();
    if (!senders_.accepts(*pose) ||
        !senders_.accepts(*pose, orca::check_age(age_of(pose->stamp()), kOldest)) ||
        orca::is_anywhere(pose->covariance())) {
      leave();
      return orca::again();
    }
    const auto door = door_.latest();
    if (!door || age_of(door->creation_time()) > kStale || !robot_.body() || *weight_ <= 0.0) {
      leave();
    } else {
      approach(*door, orca::plane_pose(*pose));
    }
    return orca::again();
  }

  [[nodiscard]] double age_of(const orca::idl::TimeValue& stamp) {
    return orca::to_seconds(now() - orca::to_time_point(stamp));
  }

  // Leaves the robot to other behaviours.
  void leave() {
    passage_.reset();
    motion_.push(orca::dont_care());
  }

  // One door, from when the robot has come to it.
  struct Passage {
    std::string name;  // of the goal beyond it
    std::uint64_t mission = 0;
    Pose2 X_WD;  // The door's middle; its x axis leads the robot through.
    Gap gap;
    bool shut = false;
    bool lined_up = false;
    bool given_up = false;
    std::optional<orca::TimePoint> waits_since{};
  };

  void approach(const Door& door, const Pose2& X_WR) {
    const Vec2 middle{door.coordinate().point().x(), door.coordinate().point().y()};
    if (passage_ && (passage_->mission != door.mission() || norm(passage_->X_WD.position() - middle) > kSame))
      passage_.reset();
    if (norm(middle - X_WR.position()) > kNear) return leave();
    if (!passage_) begin(door, middle, X_WR);
    const Pose2 robot = seen_from(passage_->X_WD, X_WR);
    const auto scan = laser_.latest();
    if (robot.x > kThrough) {
      motion_.push(orca::dont_care());
    } else if (!scan || !orca::check_age(age_of(scan->stamp()), kDeaf).ok() || !senders_.accepts(*scan)) {
      motion_.push(orca::full_stop());
    } else {
      drive(robot, look(*scan, X_WR, door.door_width().distance()));
    }
  }

  void begin(const Door& door, Vec2 middle, const Pose2& X_WR) {
    const double yaw = door.orientation().orientation().yaw();
    // A robot in the doorway, of which a predecessor knew, goes on in its direction.
    const bool inside = norm(middle - X_WR.position()) < 0.5 * kRunUp;
    const Vec2 onward = inside ? orca::direction(X_WR.yaw) : middle - X_WR.position();
    const bool ahead = dot(onward, orca::direction(yaw)) >= 0.0;
    passage_ = Passage{door.name(),
                       door.mission(),
                       {middle.x, middle.y, ahead ? yaw : orca::wrapped(yaw + std::numbers::pi)},
                       {0.0, door.door_width().distance()}};
    passage_->lined_up = inside;
  }

  // Looks at the doorway, and takes note of the gap in it.
  // @return whether the robot can pass.
  bool look(const orca::idl::LaserRangeReadings& scan, const Pose2& X_WR, double width) {
    const Pose2 X_DS = seen_from(passage_->X_WD, X_WR * orca::plane_pose(scan.pose()));
    orca::nav::beams_of({scan.ranges(), scan.min_range(), scan.max_range(), scan.angle_start(),
                         scan.angle_increment(), X_DS, X_DS},
                        kSight, beams_);
    if (!has_view(X_DS)) return passage_->gap.width >= room() && !passage_->shut;
    points_.clear();
    for (const orca::nav::Beam& beam : beams_)
      if (beam.echo) points_.push_back(beam.to);
    const orca::planning::WayPoint door{.name = {}, .place = {}, .door = orca::planning::Doorway{0.0, width}};
    if (const auto open = orca::planning::look_at(door, beams_).is_open(width)) passage_->shut = !*open;
    const auto gap = orca::doors::gap_in(points_, width);
    if (gap && !passage_->shut) {
      passage_->gap.middle += kNew * (gap->middle - passage_->gap.middle);
      passage_->gap.width += kNew * (gap->width - passage_->gap.width);
    }
    return !passage_->shut && passage_->gap.width >= room();
  }

  // Returns whether a sensor at that pose in the frame of the door sees both jambs from in front of them.
  [[nodiscard]] static bool has_view(const Pose2& X_DS) {
    return X_DS.x < -kInDoor && std::fabs(X_DS.y) < 0.5 * std::fabs(X_DS.x) && std::fabs(X_DS.yaw) < 1.0;
  }

  // Returns the least width of a gap that it drives into [m].
  [[nodiscard]] double room() const {
    const orca::planning::Body& body = *robot_.body();
    return (body.width > 0.0 ? body.width : 2.0 * body.radius) + kBeside;
  }

  void drive(const Pose2& robot, bool open) {
    if (is_wide() && !passage_->shut) {  // Who drives does that as well, and faster.
      passage_->lined_up = false;
      passage_->waits_since.reset();
      motion_.push(orca::dont_care());
      return;
    }
    if (!passage_->lined_up) {
      const auto step = orca::doors::line_up(robot, passage_->gap.middle, kRunUp, *speed_);
      if (step) return command(*step);
      passage_->lined_up = true;
    }
    if (!open) return wait();
    passage_->waits_since.reset();
    command(orca::doors::pass(robot, passage_->gap.middle, *speed_));
  }

  [[nodiscard]] bool is_wide() const { return passage_->gap.width >= room() + *wide_; }

  // Stands before the door, and gives up the goal after some time.
  void wait() {
    motion_.push(orca::full_stop());
    if (!passage_->waits_since) {
      passage_->waits_since = now();
      log_info("waits at a door on the way to " + orca::in_quotes(passage_->name) +
               ": it is shut or too narrow");
    }
    if (passage_->given_up || orca::to_seconds(now() - *passage_->waits_since) < *wait_) return;
    passage_->given_up = true;
    auto order = cancel_.loan();
    order->name() = passage_->name;
    order->kind(orca::idl::GOAL_BLOCKED);
    order->reason() = "a door on the way to " + orca::in_quotes(passage_->name) + " has stayed shut";
    order->stamp(orca::to_time_value(now()));
    if (const orca::Status sent = cancel_.send(std::move(order)); !sent.ok())
      log_warning("cannot give up the goal: " + sent.error().text());
  }

  void command(const Step& step) { motion_.push(orca::turn(step.turn_rate, step.speed, *weight_)); }

  static constexpr double kSame = 0.05;    // [m] a door that is so near is the same
  static constexpr double kStale = 0.5;    // [s] after the last word of a door nobody drives there any more
  static constexpr double kDeaf = 0.3;     // [s]
  static constexpr double kOldest = 1.0;   // [s] An older pose says where the robot was.
  static constexpr double kNear = 1.2;     // [m] from the door, from where on it takes the robot over
  static constexpr double kRunUp = 0.7;    // [m] as who drives there has it (door_run_up)
  static constexpr double kThrough = 0.6;  // [m] behind the door, where it leaves the robot to others
  static constexpr double kInDoor =
      0.15;                              // [m] before the door, from where the laser does not see both jambs
  static constexpr double kSight = 4.0;  // [m]
  static constexpr double kBeside =
      0.03;  // [m] that a gap must look wider than the robot; mixed pixels make it look narrower
  static constexpr double kNew = 0.3;  // share of a scan in what is known of the gap

  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot, in the frame of the goals."}};
  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{
      *this, "laser", {.text = "Scans in which it sees the doorway."}};
  orca::PushProxy<Door> door_{
      *this, "door", {.text = "The door that somebody drives through now, once per lap of his."}};
  orca::planning::AskedRobot robot_{*this};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "MotionCmdPush", {.text = "One command per lap; no opinion away from doors."}};
  orca::SendProxy<orca::idl::GoalFailed> cancel_{
      *this, "cancel", {.text = "Receiver of the goal that is given up at a shut door: who drives."}};
  orca::Param<double> wait_{*this,
                            "wait",
                            20.0,
                            {.unit = "s",
                             .min = 0.0,
                             .text = "Time for which it waits at a shut door before the goal is given up."}};
  orca::Param<double> wide_{*this,
                            "wide",
                            0.3,
                            {.unit = "m",
                             .min = 0.0,
                             .text = "Room beside the robot, on both sides together, from which on it leaves "
                                     "the way through an open door to who "
                                     "drives."}};
  orca::Param<double> speed_{
      *this, "speed", 0.2, {.unit = "m/s", .min = 0.02, .text = "Speed in the doorway."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  std::optional<Passage> passage_;
  std::vector<orca::nav::Beam> beams_;  // of the last scan, in the frame of the door
  std::vector<Vec2> points_;
  orca::SenderWatch senders_{host()};
};

}  // namespace

ORCA_COMPONENT(TraverseDoor, "orca.TraverseDoor")
