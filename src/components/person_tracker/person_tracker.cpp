// SPDX-License-Identifier: LGPL-3.0-or-later
#include <utility>
#include <vector>

#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/waiting_scans.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/navigation/pose_history.hpp"
#include "orca/tracking/mover_tracker.hpp"

namespace {

using orca::idl::MovingThings;

orca::idl::MovingThing thing_of(const orca::tracking::Mover& mover) {
  orca::idl::MovingThing thing;
  thing.number(mover.number);
  thing.x(mover.place.x);
  thing.y(mover.place.y);
  thing.velocity_x(mover.velocity.x);
  thing.velocity_y(mover.velocity.y);
  thing.radius(mover.radius);
  thing.place_error(mover.place_error);
  thing.velocity_error(mover.velocity_error);
  thing.unseen(mover.unseen);
  return thing;
}

/// Reports who moves near the robot, from the scans of a laser. See README.md.
class PersonTracker final : public orca::Component {
 public:
  explicit PersonTracker(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    lap_on(odometry_);
    return orca::ok();
  }

  orca::Status start() override {
    forget();
    return orca::ok();
  }

  orca::Outcome work() override {
    while (odometry_.new_data_arrived()) follow(*odometry_.get_update());
    while (laser_.new_data_arrived())
      if (auto scan = laser_.get_update(); senders_.accepts(*scan)) scans_.add(std::move(scan));
    if (!history_.empty()) track();
    return orca::again();
  }

  void forget() {
    history_.clear();
    scans_.clear();
    tracker_.clear();
  }

  void follow(const orca::idl::Odometry& odometry) {
    if (!senders_.accepts(odometry)) return;
    if (odometer_.begins_anew(odometry)) forget();  // all lies elsewhere now
    history_.add(orca::to_time_point(odometry.stamp()), orca::plane_pose(odometry));
  }

  // The scan waits for the pose of its last beam.
  void track() {
    const orca::ScanPtr scan = scans_.take_until(history_.newest());
    if (!scan) return;
    const auto stamp = orca::to_time_point(scan->stamp());
    const auto first = history_.at(stamp);
    const auto last = history_.at(orca::last_beam_of(*scan));
    if (!first || !last) return;
    const orca::Pose2 mount = orca::plane_pose(scan->pose());
    orca::nav::beams_of({scan->ranges(), scan->min_range(), scan->max_range(), scan->angle_start(),
                         scan->angle_increment(), *first * mount, *last * mount},
                        scan->max_range(), beams_);
    tracker_.see(beams_, orca::to_seconds(stamp.time_since_epoch()));
    auto moving = moving_.loan();
    moving->things().clear();
    for (const orca::tracking::Mover& mover : tracker_.movers()) moving->things().push_back(thing_of(mover));
    moving->stamp(scan->stamp());
    moving_.push(std::move(moving));
  }

  orca::PushProxy<orca::idl::Odometry> odometry_{
      *this, "odometry", {.text = "Motion of the robot.", .depth = 16}};
  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{
      *this, "laser", {.text = "Scans of the laser.", .depth = 8}};
  orca::PushServer<MovingThings> moving_{
      *this,
      "MovingThingsPush",
      {.text = "Who moves near the robot, as of each scan, in the frame of the odometry."}};

  orca::SenderWatch senders_{host()};
  orca::SenderLife odometer_;
  orca::nav::PoseHistory history_;  // in the frame of the odometry
  orca::WaitingScans scans_;
  std::vector<orca::nav::Beam> beams_;
  orca::tracking::MoverTracker tracker_;
};

}  // namespace

ORCA_COMPONENT(PersonTracker, "orca.PersonTracker")
