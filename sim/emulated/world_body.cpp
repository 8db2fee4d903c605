// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world_body.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace orca::sim {

WorldBody::WorldBody(const RobotModel& robot, Wheels wheels)
    : robot_(robot), wheels_(std::move(wheels)), sonars_(robot.sonars.empty() ? 0 : robot.sonars[0].count) {}

void WorldBody::sense(const SharedWorld::Inbox& inbox) {
  for (const auto& [ring, scan] : inbox.sonar)
    if (ring == 0) hear(scan);
  for (const auto& [ring, reading] : inbox.bumper)
    if (ring == 0) feel(robot_.bumpers[0], reading);
  for (const auto& [laser, scan] : inbox.laser)
    if (laser == 0) see(scan);
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
  wheels_(velocity);
}

std::optional<double> WorldBody::sonar(int number) const {
  const auto at = static_cast<std::size_t>(number);
  return number >= 0 && at < sonars_.size() ? sonars_[at] : std::nullopt;
}

std::optional<emulators::MirrorTurn> WorldBody::last_turn() const {
  if (!scan_) return std::nullopt;
  const LaserScanner& laser = robot_.lasers[0];
  return emulators::MirrorTurn{scan_->stamp, laser.first_angle, laser.pitch, scan_->ranges};
}

}  // namespace orca::sim
