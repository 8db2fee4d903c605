// SPDX-License-Identifier: GPL-3.0-or-later
// MoverTracker on scans of the simulator: among people whose true motion is known, and where nobody is.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/navigation/pose_history.hpp"
#include "orca/sim/robot_file.hpp"
#include "orca/sim/world.hpp"
#include "orca/sim/world_file.hpp"
#include "orca/tracking/mover_tracker.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::tracking;

namespace {

// A Pioneer that drives about and turns away from what is near, and a tracker that gets its scans.
class Stroll {
 public:
  Stroll(const std::string& world, sim::Realism realism, std::uint64_t seed, Pose2 start)
      : world_(read(world), {.seed = seed, .realism = realism}),
        robot_(*world_.add_robot("Pioneer", model(), start)),
        laser_(world_.robot_model(robot_).lasers.front()),
        random_(seed, "test", "stroll") {}

  // Drives until the next scan is tracked.
  void next_scan() {
    for (bool tracked = false; !tracked;) {
      world_.step();
      if (const auto& odometry = world_.odometry(robot_)) {
        history_.add(odometry->stamp, odometry->pose);
        X_WO_ = world_.pose(robot_) * inverse(odometry->pose);
      }
      if (const auto& scan = world_.laser(robot_)) {
        waiting_ = *scan;
        steer(*scan);
      }
      tracked = track();
    }
  }

  [[nodiscard]] const MoverTracker& tracker() const { return tracker_; }
  [[nodiscard]] const sim::World& world() const { return world_; }
  [[nodiscard]] double time() const { return to_seconds(world_.time().time_since_epoch()); }
  // Returns where a place of the tracker is in the world.
  [[nodiscard]] Vec2 in_world(Vec2 place) const { return placed(X_WO_, place); }
  [[nodiscard]] Vec2 turned(Vec2 velocity) const { return rotated(velocity, X_WO_.yaw); }
  [[nodiscard]] Pose2 pose() const { return world_.pose(robot_); }

 private:
  static sim::WorldModel read(const std::string& name) {
    xml::Diagnostics wrong;
    const auto world = sim::read_world(ORCA_SOURCE_DIR "/sim/worlds/" + name, {}, wrong);
    REQUIRE(world);
    return *world;
  }
  static sim::RobotModel model() {
    xml::Diagnostics wrong;
    const auto model = sim::read_robot(ORCA_SOURCE_DIR "/sim/robots/pioneer_2dx.urdf", wrong);
    REQUIRE(model);
    return *model;
  }
  static Vec2 placed(const Pose2& X, Vec2 place) { return X.position() + rotated(place, X.yaw); }

  void steer(const sim::LaserScan& scan) {
    double nearest = 8.0;
    for (std::size_t i = scan.ranges.size() / 6; i < scan.ranges.size() * 5 / 6; ++i)
      nearest = std::min(nearest, scan.ranges[i]);
    if (nearest > 0.9) {
      turn_ = random_.uniform(-0.3, 0.3);
      turning_ = false;
    } else if (!turning_) {
      turning_ = true;
      turn_ = random_.uniform(0.0, 1.0) < 0.5 ? -0.8 : 0.8;
    }
    REQUIRE(world_.set_velocity_command(robot_, turning_ ? 0.0 : 0.5, turn_).ok());
  }

  bool track() {
    if (!waiting_ || history_.empty() || waiting_->stamp + laser_.sweep > history_.newest()) return false;
    const auto first = history_.at(waiting_->stamp);
    const auto last = history_.at(waiting_->stamp + laser_.sweep);
    const double time = to_seconds(waiting_->stamp.time_since_epoch());
    if (first && last) {
      std::vector<nav::Beam> beams;
      nav::beams_of({waiting_->ranges, laser_.min_range, laser_.max_range, laser_.first_angle, laser_.pitch,
                     *first * laser_.center, *last * laser_.center},
                    laser_.max_range, beams);
      tracker_.see(beams, time);
    }
    waiting_.reset();
    return first && last;
  }

  sim::World world_;
  sim::RobotId robot_;
  sim::LaserScanner laser_;
  RandomStream random_;
  nav::PoseHistory history_;
  std::optional<sim::LaserScan> waiting_;
  MoverTracker tracker_;
  Pose2 X_WO_;
  double turn_ = 0.0;
  bool turning_ = false;
};

// The share of a kind of moments among others.
struct Share {
  int all = 0;
  int those = 0;
  void note(bool is_one) {
    ++all;
    those += is_one ? 1 : 0;
  }
  [[nodiscard]] double value() const { return 1.0 * those / all; }
};

// The root of a mean square.
struct Spread {
  int count = 0;
  double sum = 0.0;
  void note(Vec2 error) {
    ++count;
    sum += dot(error, error);
  }
  [[nodiscard]] double value() const { return std::sqrt(sum / count); }
};

constexpr double kSame = 0.6;  // [m] A mover so near to a person is that person.

// The true people, and what a tracker makes of them.
class Judge {
 public:
  Share found;     // people in view who walk steadily
  Share invented;  // movers that a scan shows, where nobody is
  Share switched;  // people who get another number from one scan to the next
  Spread place, velocity;

  void look(const Stroll& stroll) {
    const double time = stroll.time();
    const std::vector<Mover> movers = stroll.tracker().movers();
    std::vector<Vec2> places;
    for (const sim::Person& person : people_in(stroll.world())) {
      places.push_back(person.position);
      Walk& walk = walks_[person.name];
      const Vec2 moved = (1.0 / (time - walk.time)) * (person.position - walk.place);
      if (norm(moved - walk.velocity) > 0.1) walk.steady_since = time;
      walk = {time, walk.steady_since, person.position, moved, walk.number, walk.numbered_at};
      compare(walk, movers, stroll);
    }
    for (const Mover& mover : movers)
      if (mover.unseen == 0.0)
        invented.note(std::ranges::none_of(
            places, [&](Vec2 there) { return norm(stroll.in_world(mover.place) - there) < kSame; }));
  }

 private:
  struct Walk {
    double time = -1.0;
    double steady_since = 0.0;
    Vec2 place, velocity;
    std::uint32_t number = 0;
    double numbered_at = -1.0;
  };

  // Somebody who has turned a second ago, or is beside the field of view or far away, is not counted.
  void compare(Walk& walk, const std::vector<Mover>& movers, const Stroll& stroll) {
    const Vec2 seen = seen_from(stroll.pose(), walk.place);
    if (seen.x < 0.2 || norm(seen) > 4.0 || norm(walk.velocity) < 0.3 || walk.time - walk.steady_since < 1.0)
      return;
    const auto off = [&](const Mover& mover) { return norm(stroll.in_world(mover.place) - walk.place); };
    const auto nearest = std::ranges::min_element(movers, {}, off);
    const bool is_found = nearest != movers.end() && off(*nearest) < kSame;
    found.note(is_found);
    if (!is_found) return;
    place.note(stroll.in_world(nearest->place) - walk.place);
    velocity.note(stroll.turned(nearest->velocity) - walk.velocity);
    if (walk.time - walk.numbered_at < 0.15) switched.note(walk.number != nearest->number);
    walk.number = nearest->number;
    walk.numbered_at = walk.time;
  }

  std::map<std::string, Walk> walks_;
};

}  // namespace

TEST_CASE("a robot that drives about among six people knows who walks where", "[tracking][sim]") {
  Judge judge;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Stroll stroll("crowd.xml", sim::Realism::nominal, seed, {1.0, 1.5, 0.7});
    while (stroll.time() < 120.0) {
      stroll.next_scan();
      judge.look(stroll);
    }
  }
  CAPTURE(judge.found.all, judge.found.value(), judge.invented.value(), judge.switched.value());
  CAPTURE(judge.place.value(), judge.velocity.value());
  CHECK(judge.found.all > 1000);
  CHECK(judge.found.value() > 0.9);
  CHECK(judge.invented.value() < 0.03);
  CHECK(judge.switched.value() < 0.02);
  CHECK(judge.place.value() < 0.15);
  CHECK(judge.velocity.value() < 0.3);
}

TEST_CASE("where nothing moves hardly any mover is seen, whatever noise, drift and drop-outs there are",
          "[tracking][sim]") {
  const auto level = GENERATE(sim::Realism::nominal, sim::Realism::harsh);
  const auto [world, start] = GENERATE(table<const char*, Pose2>(
      {{"office.xml", {0.9, 6.0, 0.0}}, {"hall.xml", {1.5, 1.5, 0.7}}, {"warehouse.xml", {1.0, 1.0, 0.0}}}));
  const double time = test::part_of(3600);  // [s]
  Stroll stroll(world, level, 1, start);
  Share invented;
  std::uint32_t movers = 0;
  while (stroll.time() < time) {
    stroll.next_scan();
    const std::vector<Mover> found = stroll.tracker().movers();
    invented.note(!found.empty());
    for (const Mover& mover : found) movers = std::max(movers, mover.number);
  }
  CAPTURE(world, level == sim::Realism::harsh, movers, invented.value());
  CHECK(invented.value() < 0.04);
}
