// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <vector>

#include "orca/avoidance/advice.hpp"
#include "orca/avoidance/ring_ear.hpp"
#include "orca/avoidance/scan.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/own_beams.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "walk.hpp"

namespace {

/// A behaviour that drives about: straight on, then away by a random turn where sonars or laser find the way
/// blocked. Beside an avoid behaviour it only gives the robot something to do. Alone it stops short of
/// obstacles, but keeps no distance from things that it passes.
class RandomWalk final : public orca::Component {
 public:
  explicit RandomWalk(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(50));
  }

 private:
  orca::Status configure() override {
    if (!sonar_.connected() && !laser_.connected())
      return orca::fail(orca::Code::failed_precondition,
                        "connect its port sonar or laser: it must see when the way is blocked");
    random_.emplace(random("walk"));
    return params_changed();
  }

  orca::Status params_changed() override {
    if (*least_turn_ <= *greatest_turn_) return orca::ok();
    return least_turn_.refuse("it must not be above greatest_turn");
  }

  orca::Status start() override {
    motion_.start(lap_period());
    return orca::ok();
  }

  orca::Outcome work() override {
    hear();
    if (!heard_at_ || orca::to_seconds(now() - *heard_at_) > *deaf_after_) {
      motion_.push(orca::full_stop());
      return orca::again();
    }
    const orca::avoid::Limits body{.robot_radius = *robot_radius_,
                                   .margin = *margin_,
                                   .side_distance = 0.0,
                                   .safe_distance = 2.0 * *blocked_at_,
                                   .stop_distance = *blocked_at_,
                                   .max_speed = *speed_};
    const double way = free_way(echoes_, 0.0, body);
    const orca::walk::Step step = walk_.step(orca::to_seconds(now()), way, limits(), *random_);
    motion_.push(orca::turn(step.turn_rate, step.speed, *weight_));
    return orca::again();
  }

  // Replaces the former readings of each sensor by its newest ones.
  void hear() {
    if (!sonar_.new_data_arrived() && !laser_.new_data_arrived()) return;
    echoes_.clear();
    if (sonar_.new_data_arrived()) last_sonar_ = sonar_.get_update();
    if (laser_.new_data_arrived()) last_laser_ = laser_.get_update();
    const bool sound =
        (!last_sonar_ || counts(*last_sonar_)) && (!last_laser_ || counts(*last_laser_)) && looks_ahead();
    heard_at_ = sound ? std::optional(now()) : std::nullopt;
    if (!sound) return;
    if (last_sonar_) hear_round(*last_sonar_);
    if (last_laser_) hear_scan(*last_laser_);
  }

  // Returns whether readings show the way ahead and are not too old. One of two sensors that has fallen silent is found by
  // the age of its last reading.
  bool counts(const orca::idl::LaserRangeReadings& scan) {
    return senders_.accepts(scan) && senders_.accepts(scan, orca::check_view_ahead(scan)) &&
           senders_.accepts(scan, orca::check_age(age_of(orca::to_time_point(scan.stamp())), *deaf_after_));
  }
  bool counts(const orca::idl::SonarRangeReadings& round) {
    const auto fired = orca::avoid::RingEar::last_firing(round);
    return senders_.accepts(round) && senders_.accepts(round, orca::check_view_ahead(round)) &&
           (!fired || senders_.accepts(
                          round, orca::avoid::check_firing(age_of(*fired), *deaf_after_, "sonar", "fired")));
  }

  // Returns whether one of its sensors looks where it drives.
  bool looks_ahead() {
    if (last_sonar_ && orca::check_looks_ahead(*last_sonar_).ok()) return true;
    if (last_laser_) return senders_.accepts(*last_laser_, orca::check_looks_ahead(*last_laser_));
    return senders_.accepts(*last_sonar_, orca::check_looks_ahead(*last_sonar_));
  }

  [[nodiscard]] double age_of(orca::TimePoint stamp) const { return orca::to_seconds(now() - stamp); }

  void hear_round(const orca::idl::SonarRangeReadings& round) {
    for (std::size_t i = 0; i < std::min(round.ranges().size(), round.poses().size()); ++i)
      note(round, i, orca::plane_pose(round.poses()[i]));
  }

  void hear_scan(const orca::idl::LaserRangeReadings& scan) {
    const orca::Pose2 mount = orca::plane_pose(scan.pose());
    for (std::size_t i = 0; i < scan.ranges().size(); ++i) {
      const double angle = scan.angle_start() + scan.angle_increment() * static_cast<double>(i);
      note(scan, i, {mount.x, mount.y, mount.yaw + angle});
    }
  }

  void note(const orca::idl::RangeReadings& readings, std::size_t i, const orca::Pose2& beam) {
    const auto echo =
        orca::avoid::echo_of(readings.ranges()[i], readings.min_range(), readings.max_range(), beam);
    if (echo) echoes_.push_back(*echo);
  }

  [[nodiscard]] orca::walk::Limits limits() const {
    return {*speed_, *turn_rate_, *least_turn_, *greatest_turn_, *blocked_at_, *longest_way_};
  }

  orca::PushProxy<orca::idl::SonarRangeReadings> sonar_{
      *this,
      "sonar",
      {.text = "Readings of the sonars; sonar or laser must be connected.", .optional = true}};
  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{
      *this, "laser", {.text = "Scans of the laser; sonar or laser must be connected.", .optional = true}};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "motion", {.text = "One command per lap: a wish, or full stop while no readings come."}};

  orca::Param<double> speed_{
      *this, "speed", 0.3, {.unit = "m/s", .min = 0.0, .text = "Speed while it drives straight on."}};
  orca::Param<double> turn_rate_{
      *this, "turn_rate", 0.8, {.unit = "rad/s", .min = 0.01, .text = "Turn rate of its turns on the spot."}};
  orca::Param<double> least_turn_{
      *this, "least_turn", 0.8, {.unit = "rad", .min = 0.0, .max = 6.3, .text = "Smallest random turn."}};
  orca::Param<double> greatest_turn_{
      *this, "greatest_turn", 2.6, {.unit = "rad", .min = 0.0, .max = 6.3, .text = "Largest random turn."}};
  orca::Param<double> blocked_at_{
      *this, "blocked_at", 0.5, {.unit = "m", .min = 0.05, .text = "Free way ahead at which it turns away."}};
  orca::Param<double> longest_way_{
      *this,
      "longest_way",
      20.0,
      {.unit = "s",
       .min = 0.0,
       .text = "Longest time straight on; each time is drawn below it. 0: until the way is blocked."}};
  orca::Param<double> robot_radius_{
      *this,
      "robot_radius",
      0.205,
      {.unit = "m", .min = 0.0, .text = "Radius of the circle that holds the robot."}};
  orca::Param<double> margin_{
      *this,
      "margin",
      0.1,
      {.unit = "m", .min = 0.0, .text = "Free space to keep on both sides of the robot."}};
  orca::Param<double> deaf_after_{
      *this,
      "deaf_after",
      0.6,
      {.unit = "s", .min = 0.0, .text = "The robot stops after this time without sensor readings."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  orca::SenderWatch senders_{host()};
  orca::walk::Walk walk_;
  std::optional<orca::RandomStream> random_;
  std::vector<orca::Vec2> echoes_;
  orca::ObjectPtr<orca::idl::SonarRangeReadings> last_sonar_;
  orca::ObjectPtr<orca::idl::LaserRangeReadings> last_laser_;
  std::optional<orca::TimePoint> heard_at_;
};

}  // namespace

ORCA_COMPONENT(RandomWalk, "orca.RandomWalk")
