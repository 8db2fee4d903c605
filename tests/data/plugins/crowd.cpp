// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "orca/component.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/waiting_scans.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/pose_history.hpp"

namespace {

using orca::Pose2;
using orca::Vec2;
using orca::idl::LaserRangeReadings;

/// People around a robot for those who take their scans here; whoever takes them from the laser does not see them.
///
/// They are upright cylinders in the frame of the world. Each walks at up to 1.5 m/s to a place beside or before the robot, 0.6 to 3 m off,
/// keeps beside the robot there for a while, and then walks to another one, across its way or not. They stop for the robot, not for each
/// other. Who would stand in a wall or in furniture, as far as the laser sees that, is not there, and goes elsewhere. To a place near the robot go those who are to hide more beams: over a run it is the `share` of all.
class Crowd final : public orca::Component {
 public:
  explicit Crowd(orca::ComponentHost& host) : Component(host) { lap_on("truth"); }

 private:
  static constexpr double kNearest = 0.6;   // [m] A Pioneer's radius and theirs.
  static constexpr double kNear = 1.5;      // [m]
  static constexpr double kFarthest = 3.0;  // [m]

  struct Person {
    double radius = 0.0;    // [m]
    Vec2 at;                // in the world
    Vec2 goal;              // in the robot's frame
    double speed = 0.0;     // [m/s]
    orca::TimePoint until;  // when it goes elsewhere
  };

  orca::Status configure() override {
    stay_active(true);
    random_.emplace(random("people"));
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto pose = truth_.get_update();
    history_.add(orca::to_time_point(pose->stamp()), orca::plane_pose(*pose));
    while (laser_.new_data_arrived()) waiting_.add(laser_.get_update());
    if (const auto scan = waiting_.take_until(history_.newest())) pass_on(scan);
    return orca::again();
  }

  void stop() override {
    char text[80];
    std::snprintf(text, sizeof text, "people hid %.2f %% of %.0f beams",
                  100.0 * hidden_ / std::max(1.0, beams_), beams_);
    log_info(text);
  }

  /// A beam in the frame of the world.
  struct Ray {
    Vec2 from, ahead;
  };

  void pass_on(const orca::ScanPtr& scan) {
    const auto first = history_.at(orca::to_time_point(scan->stamp()));
    const auto last = history_.at(orca::last_beam_of(*scan));
    if (!first || !last) return;
    walk(*scan, *first);
    const std::vector<Ray> rays = rays_of(*scan, *first, *last);
    auto seen = copy_value(scan);
    for (Person& person : people_)
      if (!stand_before(person, *scan, rays, *seen)) person.until = orca::TimePoint{};
    const auto& deviations = scan->ranges_uncertainty();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!(seen->ranges()[i] < scan->ranges()[i])) continue;
      const double noise = random_->normal(0.0, i < deviations.size() ? deviations[i] : 0.0);
      seen->ranges()[i] = std::max(scan->min_range(), seen->ranges()[i] + noise);
      ++hidden_;
    }
    beams_ += static_cast<double>(rays.size());
    out_.push(std::move(seen));
  }

  static std::vector<Ray> rays_of(const LaserRangeReadings& scan, const Pose2& first, const Pose2& last) {
    std::vector<Ray> rays;
    const auto count = static_cast<double>(scan.ranges().size());
    for (double beam = 0.0; beam < count; ++beam) {
      const Pose2 X_WS = orca::nav::between(first, last, beam / count) * orca::plane_pose(scan.pose());
      rays.push_back({X_WS.position(), orca::direction(X_WS.yaw + angle_of(scan, beam))});
    }
    return rays;
  }

  // Returns the bearing of a beam in the laser's frame.
  static double angle_of(const LaserRangeReadings& scan, double beam) {
    return scan.angle_start() + beam * scan.angle_increment();
  }

  // Shortens the beams that a person stands in. Returns false, and shortens none, if the laser sees something there that would be within
  // or before the person: nobody stands in a wall, and those behind one are not seen.
  static bool stand_before(const Person& person, const LaserRangeReadings& scan, const std::vector<Ray>& rays,
                           LaserRangeReadings& seen) {
    std::vector<double> ranges = seen.ranges();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Vec2 there = person.at - rays[i].from;
      const double along = dot(there, rays[i].ahead);
      const double aside = cross(rays[i].ahead, there);
      if (along <= 0.0 || std::fabs(aside) >= person.radius) continue;
      const double depth = std::sqrt(person.radius * person.radius - aside * aside);
      if (!(scan.ranges()[i] >= along + depth)) return false;
      ranges[i] = std::min(ranges[i], along - depth);
    }
    seen.ranges() = std::move(ranges);
    return true;
  }

  // Lets everybody walk until a scan's first beam, at which the robot is at X_WR.
  void walk(const LaserRangeReadings& scan, const Pose2& X_WR) {
    const orca::TimePoint now = orca::to_time_point(scan.stamp());
    const bool begins = people_.empty();
    people_.resize(static_cast<std::size_t>(*count_));
    for (Person& person : people_) {
      if (now >= person.until) draw_goal(person, scan, now);
      const Vec2 goal = X_WR * person.goal;
      if (begins) {
        person.radius = random_->uniform(0.25, 0.3);
        person.at = goal;
      }
      person.at = person.at + shortened(goal - person.at, person.speed * orca::to_seconds(now - walked_));
      const Vec2 off = person.at - X_WR.position();
      if (norm(off) < kNearest) person.at = X_WR.position() + (kNearest / std::max(1e-3, norm(off))) * off;
    }
    walked_ = now;
  }

  // Draws where a person goes next: to where the laser sees nothing yet.
  void draw_goal(Person& person, const LaserRangeReadings& scan, orca::TimePoint now) {
    constexpr int kTries = 20;
    const bool is_near = hidden_ < *share_ * beams_;
    for (int i = 0; i < kTries; ++i) {
      const double beam = random_->uniform(0.0, static_cast<double>(scan.ranges().size()));
      const double way = is_near ? random_->uniform(kNearest, kNear) : random_->uniform(kNear, kFarthest);
      person.goal = orca::plane_pose(scan.pose()) * (way * orca::direction(angle_of(scan, beam)));
      if (scan.ranges()[static_cast<std::size_t>(beam)] > way + person.radius) break;
    }
    person.speed = random_->uniform(0.5, 1.5);
    person.until = now + orca::from_seconds(random_->uniform(2.0, 6.0));
  }

  orca::PushProxy<LaserRangeReadings> laser_{*this, "laser"};
  orca::PushProxy<orca::idl::RobotPose> truth_{*this, "truth"};
  orca::PushServer<LaserRangeReadings> out_{*this, "laser_out"};
  orca::Param<double> share_{*this, "share", 0.3, {.min = 0.0, .max = 1.0}};
  orca::Param<std::int64_t> count_{*this, "people", 4, {.min = 0.0, .max = 20.0}};
  std::optional<orca::RandomStream> random_;
  orca::nav::PoseHistory history_;
  orca::WaitingScans waiting_;
  std::vector<Person> people_;
  orca::TimePoint walked_{};
  double hidden_ = 0.0;
  double beams_ = 0.0;
};

}  // namespace

ORCA_COMPONENT(Crowd, "test.Crowd")
