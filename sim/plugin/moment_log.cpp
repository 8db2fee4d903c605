// SPDX-License-Identifier: LGPL-3.0-or-later
#include "moment_log.hpp"

namespace orca::sim {
namespace {

constexpr std::size_t kMost = 512;

std::vector<Scene::Cone> cones_of(const SonarScan& scan, const SonarRing& ring) {
  std::vector<Scene::Cone> cones;
  for (const SonarReading& reading : scan.readings)
    cones.push_back({reading.sensor, ring.half_lobe, reading.range, reading.echo});
  return cones;
}

Scene::Scan scan_of(const LaserScan& scan, const LaserScanner& laser) {
  const Pose2 at = scan.X_RB * laser.center;
  Scene::Scan drawn{at.position(), {}};
  for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
    const double angle = at.yaw + laser.first_angle + static_cast<double>(k) * laser.pitch;
    drawn.ends.push_back(at.position() + scan.ranges[k] * direction(angle));
  }
  return drawn;
}

}  // namespace

void MomentLog::add(const SharedWorld::Inbox& inbox) {
  see(inbox);
  for (const SharedWorld::Inbox::Truth& truth : inbox.truth) {
    now_.time = truth.stamp;
    now_.pose = truth.pose;
    now_.speed = truth.velocity.forward;
    now_.turn_rate = truth.velocity.turn_rate;
    keep();
  }
}

// Records what the robot sensed. If it has several rings, the first is drawn.
void MomentLog::see(const SharedWorld::Inbox& inbox) {
  for (const auto& [ring, scan] : inbox.sonar)
    if (ring == 0) now_.sonar = cones_of(scan, robot_.sonars[ring]);
  now_.lasers.resize(robot_.lasers.size());
  for (const auto& [laser, scan] : inbox.laser) now_.lasers[laser] = scan_of(scan, robot_.lasers[laser]);
}

void MomentLog::keep() {
  if (count_++ % step_ != 0) return;
  kept_.push_back(now_);
  if (kept_.size() < kMost) return;
  for (std::size_t i = 1; 2 * i < kept_.size(); ++i) kept_[i] = std::move(kept_[2 * i]);
  kept_.resize((kMost + 1) / 2);
  step_ *= 2;
}

std::vector<Scene::Moment> MomentLog::moments() const {
  std::vector<Scene::Moment> all = kept_;
  if (!all.empty() && all.back().time < now_.time) all.push_back(now_);
  return all;
}

}  // namespace orca::sim
