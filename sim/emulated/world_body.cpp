// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world_body.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace orca::sim {

namespace {

GripperOrder order_for(emulators::GripperMove move) {
  using Move = emulators::GripperMove;
  switch (move) {
    case Move::open: return {.paddles = Paddles::open};
    case Move::close: return {.paddles = Paddles::close};
    case Move::stop: return {.paddles = Paddles::halt};
    case Move::up: return {.lift = Lift::up};
    case Move::down: return {.lift = Lift::down};
    case Move::stop_lift: return {.lift = Lift::halt};
  }
  return {};
}

}  // namespace

WorldBody::WorldBody(const RobotModel& robot, Motors motors)
    : robot_(robot), motors_(std::move(motors)), sonars_(robot.sonars.empty() ? 0 : robot.sonars[0].count) {}

void WorldBody::sense(const SharedWorld::Inbox& inbox) {
  for (const auto& [ring, scan] : inbox.sonar)
    if (ring == 0) hear(scan);
  for (const auto& [ring, reading] : inbox.bumper)
    if (ring == 0) feel(robot_.bumpers[0], reading);
  for (const auto& [laser, scan] : inbox.laser)
    if (laser == 0) see(scan);
  if (!inbox.gripper.empty()) gripper_ = inbox.gripper.back();
  if (!inbox.battery.empty()) {
    battery_voltage_ = inbox.battery.back().voltage;
    is_charged_ = inbox.battery.back().charging;
  }
  for (const OdometryReading& reading : inbox.odometry) {
    if (stall_.look(reading)) stalled_ = true;
    if (!stall_.is_slow(reading)) stalled_ = false;
    odometry_ = reading;
  }
}

void WorldBody::hear(const SonarScan& scan) {
  for (const SonarReading& reading : scan.readings)
    sonars_.at(reading.transducer) = reading.echo ? std::optional(reading.range) : std::nullopt;
}

void WorldBody::feel(const BumperRing& ring, const BumperReading& reading) {
  bumpers_ = 0;
  unsigned front = 0;
  unsigned rear = 0;
  for (std::size_t k = 0; k < reading.pressed.size(); ++k) {
    const bool ahead = ring.angles.empty() || std::abs(ring.segment(k).yaw) < 0.5 * std::numbers::pi;
    const unsigned bit = ahead ? front++ : 8 + rear++;
    if (reading.pressed[k]) bumpers_ = static_cast<std::uint16_t>(bumpers_ | (1U << bit));
  }
}

void WorldBody::see(LaserScan scan) {
  for (double& range : scan.ranges)
    if (range >= robot_.lasers[0].max_range) range = std::numeric_limits<double>::infinity();
  scan_ = std::move(scan);
}

void WorldBody::drive(const Twist2& velocity) {
  stall_.driven(velocity, odometry_.stamp);
  motors_.wheels(velocity);
}

std::optional<double> WorldBody::sonar(int number) const {
  const auto at = static_cast<std::size_t>(number);
  return number >= 0 && at < sonars_.size() ? sonars_[at] : std::nullopt;
}

void WorldBody::move_gripper(emulators::GripperMove move) {
  if (robot_.gripper) motors_.gripper(order_for(move));
}

// Before its first reading it looks as it does at the start. Its controller takes paddles as closed that have closed on something, and
// those that meet press on each other.
std::optional<emulators::GripperLook> WorldBody::gripper() const {
  if (!robot_.gripper) return std::nullopt;
  GripperReading reading;
  reading.is_open = true;
  if (gripper_) reading = *gripper_;
  const bool closed = reading.is_closed || reading.holds;
  return emulators::GripperLook{.open = reading.is_open,
                                .closed = closed,
                                .paddles_move = reading.paddles_move,
                                .up = reading.lift == 1.0,
                                .down = reading.lift == 0.0,
                                .lift_moves = reading.lift_moves,
                                .inner_beam = reading.inner_beam,
                                .outer_beam = reading.outer_beam,
                                .left_contact = closed,
                                .right_contact = closed};
}

std::optional<emulators::MirrorTurn> WorldBody::last_turn() const {
  if (!scan_) return std::nullopt;
  const LaserScanner& laser = robot_.lasers[0];
  const double sense = laser.upside_down ? -1.0 : 1.0;  // the device does not know how it hangs
  return emulators::MirrorTurn{scan_->stamp, sense * laser.first_angle, sense * laser.pitch, scan_->ranges,
                               laser.upside_down};
}

}  // namespace orca::sim
