// SPDX-License-Identifier: LGPL-3.0-or-later
#include "senses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::localizer {
namespace {

// Returns the element with that path, a new one if there is none.
template <typename Source>
Source& source_at(std::vector<Source>& sources, const std::string& path) {
  const auto found = std::ranges::find(sources, path, &Source::path);
  if (found != sources.end()) return *found;
  sources.push_back({path, {}});
  return sources.back();
}

}  // namespace

void Scans::add(const std::string& laser, ScanPtr scan) {
  source_at(lasers_, laser).waiting.add(std::move(scan));
}

void Scans::clear() {
  for (Laser& laser : lasers_) laser.waiting.clear();
}

std::optional<TakenScan> Scans::take(const nav::PoseHistory& odometry, double range) {
  if (odometry.empty()) return std::nullopt;
  for (std::size_t i = 0; i < lasers_.size(); ++i) {
    const ScanPtr scan = lasers_[i].waiting.take_until(odometry.newest());
    if (!scan) continue;
    const auto first = odometry.at(to_time_point(scan->stamp()));
    const auto last = odometry.at(last_beam_of(*scan));
    if (!first || !last) continue;
    const Pose2 X_RS = plane_pose(scan->pose());
    nav::beams_of({scan->ranges(), scan->min_range(), scan->max_range(), scan->angle_start(),
                   scan->angle_increment(), *first * X_RS, *last * X_RS},
                  range, beams_);
    std::vector<Vec2> points;
    for (const nav::Beam& beam : beams_)
      if (beam.echo) points.push_back(seen_from(*first, beam.to));
    return TakenScan{{i, X_RS.position(), nav::surface_of(points, X_RS.position()), scan->ranges().size()},
                     to_time_point(scan->stamp()),
                     *first};
  }
  return std::nullopt;
}

void Echoes::add(const std::string& path, const idl::SonarRangeReadings& round,
                 const nav::PoseHistory& odometry) {
  Ring& ring = source_at(rings_, path);
  const std::size_t count = std::min({round.ranges().size(), round.poses().size(), round.stamps().size()});
  ring.stamps.resize(count, TimePoint::min());
  for (std::size_t i = 0; i < count; ++i) {
    const TimePoint stamp = to_time_point(round.stamps()[i]);
    if (stamp == std::exchange(ring.stamps[i], stamp)) continue;
    const auto X_OR = odometry.at(stamp);
    // NaN is no range, and one that is too near says only that something is at the robot.
    if (!X_OR || !(round.ranges()[i] >= round.min_range())) continue;
    fired_.push_back({*X_OR * plane_pose(round.poses()[i]),
                      {{}, round.ranges()[i], round.max_range(), round.half_lobe()}});
  }
}

std::vector<nav::SonarEcho> Echoes::take(const Pose2& X_OR) {
  std::vector<nav::SonarEcho> echoes;
  for (const Fired& fired : fired_) {
    echoes.push_back(fired.echo);
    echoes.back().X_RS = seen_from(X_OR, fired.X_OS);
  }
  fired_.clear();
  return echoes;
}

}  // namespace orca::localizer
