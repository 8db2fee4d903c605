// SPDX-License-Identifier: LGPL-3.0-or-later
#include "laser_model.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::sim::detail {
namespace {

// [m] A smaller difference of depth within one spot is not mixed: it is below the device's resolution.
constexpr double kDepthEdge = 0.01;
// Number of halvings in the search for an edge within a spot: the result is exact to 2^-12 of its half width.
constexpr int kHalvings = 12;
// Number of successive beams that share a view.
constexpr std::size_t kTogether = 16;

Ray turned(Ray ray, double angle) {
  ray.direction = rotated(ray.direction, angle);
  return ray;
}

}  // namespace

LaserModel::LaserModel(LaserScanner scanner, const ErrorLevels& errors, RandomStream random, TimePoint start)
    : scanner_(std::move(scanner)),
      errors_(errors),
      random_(random),
      drop_tangent_(portable::tan(errors.laser_drop_angle)),
      bias_(random_.uniform(-errors.laser_bias, errors.laser_bias)),
      scan_end_(start + scanner_.period) {
  scanner_.divergence *= errors.laser_spot;
}

TimePoint LaserModel::due(std::size_t beam) const {
  if (scanner_.count < 2) return scan_end_;
  const auto left = static_cast<std::int64_t>(scanner_.count - 1 - beam);
  return scan_end_ - Duration{scanner_.sweep.count() * left / static_cast<std::int64_t>(scanner_.count - 1)};
}

Ray LaserModel::ray(const Pose2& X_WB, double beam, std::size_t own_body) const {
  const Pose2 X_WL = X_WB * scanner_.center;
  const double angle = scanner_.first_angle + beam * scanner_.pitch;
  return {X_WL.position(), direction(X_WL.yaw + angle), scanner_.max_range, scanner_.height, own_body};
}

void LaserModel::run(const Caster& caster, std::size_t own_body, const TickSpan& span) {
  completed_.reset();
  bool looking = false;
  for (TimePoint next = due(ranges_.size()); next <= span.to; next = due(ranges_.size())) {
    if (ranges_.empty()) X_RB_ = span.in_robot(next);
    if (!looking || ranges_.size() % kTogether == 0) look(caster, own_body, span);
    looking = true;
    const Ray ray = this->ray(span.at(next), static_cast<double>(ranges_.size()), own_body);
    shoot(caster, {ray, view_.cast(ray)});
    if (ranges_.size() == scanner_.count) complete();
  }
}

// Makes the view for the next beams, up to the next multiple of kTogether. It covers all poses that the robot
// has meanwhile.
void LaserModel::look(const Caster& caster, std::size_t own_body, const TickSpan& span) {
  const std::size_t left = kTogether - ranges_.size() % kTogether;
  const double turn = std::fabs(wrapped(span.X_to.yaw - span.X_from.yaw));
  const double way = norm(span.X_to.position() - span.X_from.position());
  const double half = 0.5 * static_cast<double>(left);
  view_.look(caster, ray(span.X_to, static_cast<double>(ranges_.size()) + half, own_body),
             half * std::fabs(scanner_.pitch) + turn, way + turn * norm(scanner_.center.position()));
}

void LaserModel::shoot(const Caster& caster, const Beam& beam) {
  ranges_.push_back(returns(beam.hit) ? beam.hit.range : scanner_.max_range);
  const std::size_t k = ranges_.size() - 1;
  // A spot can hold an edge only if two neighbouring beams meet different surfaces.
  if (errors_.mixed_pixels && k > 0 && beam.hit.surface != previous_.hit.surface) {
    const double rim = std::copysign(0.5 * scanner_.divergence, scanner_.pitch);
    mix(caster, previous_, rim, ranges_[k - 1]);
    mix(caster, beam, -rim, ranges_[k]);
  }
  previous_ = beam;
}

bool LaserModel::returns(const Hit& hit) const { return hit.found() && hit.steeper_than(drop_tangent_); }

// Sets `range` to the mean of the two surfaces that the spot lies on, weighted by their shares of its width.
// A surface that returns nothing has no share. `rim` [rad] is the spot's end on the side to look at.
void LaserModel::mix(const Caster& caster, const Beam& beam, double rim, double& range) const {
  const Hit other = caster.cast(turned(beam.ray, rim));
  if (!returns(beam.hit) || !returns(other)) return;
  if (std::fabs(other.range - beam.hit.range) < kDepthEdge) return;
  double inside = 0.0;
  double outside = rim;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    const double depth = caster.cast(turned(beam.ray, middle)).range;
    const bool same = std::fabs(depth - beam.hit.range) < std::fabs(depth - other.range);
    (same ? inside : outside) = middle;
  }
  range += (rim - inside) / (2.0 * rim) * (other.range - beam.hit.range);
}

void LaserModel::complete() {
  LaserScan scan{due(0), std::move(ranges_), X_RB_};
  for (double& range : scan.ranges) range = measured(range);
  completed_ = std::move(scan);
  ranges_.clear();
  ranges_.reserve(scanner_.count);
  scan_end_ += scanner_.period;
}

double LaserModel::measured(double range) {
  // The noise is drawn for every beam, so that one more return does not shift all later noise.
  const double noise = random_.normal(0.0, errors_.laser_sigma);
  if (range >= scanner_.max_range) return scanner_.max_range;
  double reading = range + bias_ + noise;
  if (errors_.quantised && scanner_.quantum > 0.0)
    reading = std::round(reading / scanner_.quantum) * scanner_.quantum;
  return std::clamp(reading, scanner_.min_range, scanner_.max_range);
}

}  // namespace orca::sim::detail
