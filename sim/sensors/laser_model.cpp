// SPDX-License-Identifier: LGPL-3.0-or-later
#include "laser_model.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <utility>

#include "orca/base/portable_math.hpp"
#include "rays/intersect.hpp"

namespace orca::sim::detail {
namespace {

// [m] A smaller difference of depth within one spot is not mixed: it is below the device's resolution.
constexpr double kDepthEdge = 0.01;
// Number of halvings in the search for an edge within a spot: the result is exact to 2^-12 of its half width.
constexpr int kHalvings = 12;
// Number of successive beams that share a view.
constexpr std::size_t kTogether = 16;

// Shares of the light that surfaces scatter, by Finish. SICK's operating instructions give 50 % for grey PVC and 40 % for wood,
// 2.4 % for black foam rubber. Glass that is met head on is taken for a plain surface.
constexpr std::array kRemissions{0.5, 0.024, 0.5};
constexpr double kWeak = 0.1;  // The share of the surface that ErrorLevels::laser_threshold refers to.
// Tangent of the incidence up to which glass returns light: 5 degrees, an own estimate.
constexpr double kHeadOn = 0.0875;
constexpr int kMostPanes = 16;    // Faces of glass that a beam goes through.
constexpr double kBehind = 1e-6;  // [m] So far behind a face a beam goes on.
// The variance of a range at the weakest echo, as a multiple of that of a strong one, less 1. It is fitted to the statistical errors
// that SICK gives for the LMS5xx: 6, 8 and 14 mm up to 10, 20 and 30 m.
constexpr double kNoiseOfWeak = 10.0;

Ray turned(Ray ray, double angle) {
  ray.direction = rotated(ray.direction, angle);
  return ray;
}

}  // namespace

LaserModel::LaserModel(LaserScanner scanner, const std::vector<Shape>& own, const ErrorLevels& errors,
                       RandomStream random, TimePoint start)
    : scanner_(std::move(scanner)),
      errors_(errors),
      random_(random),
      drop_tangent_(portable::tan(errors.laser_drop_angle)),
      bias_(random_.uniform(-errors.laser_bias, errors.laser_bias)),
      scan_end_(start + scanner_.period) {
  scanner_.divergence *= errors.laser_spot;
  for (const Shape& shape : own) {
    if (const auto* circle = std::get_if<Circle>(&shape)) own_circles_.push_back(*circle);
    const std::vector<Segment> edges = edges_of(shape);
    own_edges_.insert(own_edges_.end(), edges.begin(), edges.end());
  }
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
    const auto beam = static_cast<double>(ranges_.size());
    const Ray ray = this->ray(span.at(next), beam, own_body);
    const double angle = scanner_.first_angle + beam * scanner_.pitch;
    shoot(caster, {ray, angle, seen(caster, ray, angle, view_.cast(ray))});
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
  strengths_.push_back(beam.hit.found() ? strength_of(beam.hit) : 0.0);
  const std::size_t k = ranges_.size() - 1;
  // A spot can hold an edge only if two neighbouring beams meet different surfaces.
  if (errors_.mixed_pixels && k > 0 && beam.hit.surface != previous_.hit.surface) {
    const double rim = std::copysign(0.5 * scanner_.divergence, scanner_.pitch);
    mix(caster, previous_, rim, ranges_[k - 1]);
    mix(caster, beam, -rim, ranges_[k]);
  }
  previous_ = beam;
}

// Returns the first thing that a beam sees. `hit` is what it meets first in the world.
Hit LaserModel::seen(const Caster& caster, const Ray& ray, double angle, Hit hit) const {
  hit = through_glass(caster, ray, hit);
  if (!own_circles_.empty() || !own_edges_.empty()) look_at_own(angle, hit);
  return hit;
}

// Replaces the hit by what the beam meets of the robot itself, if that is nearer. Such a hit is given in the base frame.
void LaserModel::look_at_own(double angle, Hit& hit) const {
  constexpr std::uint64_t kFirst = std::uint64_t{1}
                                   << 63U;  // Number of the first element; those of the world are smaller.
  const Vec2 origin = scanner_.center.position();
  const Vec2 ahead = direction(scanner_.center.yaw + angle);
  std::uint64_t number = kFirst;
  const auto test = [&](const auto& boundary) {
    if (meet(origin, ahead, boundary, hit.range))
      hit = {hit.range, boundary, number, origin + hit.range * ahead, ahead, Finish::plain};
    ++number;
  };
  for (const Circle& circle : own_circles_) test(circle);
  for (const Segment& edge : own_edges_) test(edge);
}

// Returns the first thing on a ray that is not glass, or glass that is met head on. `hit` is what the ray meets first. At
// ideal all surfaces are alike.
Hit LaserModel::through_glass(const Caster& caster, const Ray& ray, Hit hit) const {
  if (errors_.laser_threshold == 0.0) return hit;
  Ray rest = ray;
  double gone = 0.0;
  for (int pane = 0; pane < kMostPanes && hit.finish == Finish::glass && !hit.steeper_than(kHeadOn); ++pane) {
    gone += hit.range + kBehind;
    rest.origin = ray.origin + gone * ray.direction;
    rest.max_range = ray.max_range - gone;
    if (rest.max_range <= 0.0) break;
    hit = caster.cast(rest);
    hit.range += gone;
  }
  return hit;
}

// Returns how strong the echo is, as a multiple of the weakest that half of the beams return: light that is scattered by a matt
// surface fades with the cosine of the incidence and the square of the range.
double LaserModel::strength_of(const Hit& hit) const {
  if (errors_.laser_threshold == 0.0) return std::numeric_limits<double>::infinity();
  const double share = kRemissions[static_cast<std::size_t>(hit.finish)] / kWeak;
  const double nearer = scanner_.max_range / hit.range;
  return share * portable::cos(hit.incidence()) * nearer * nearer / errors_.laser_threshold;
}

bool LaserModel::returns(const Hit& hit) const { return hit.found() && hit.steeper_than(drop_tangent_); }

// Sets `range` to the mean of the two surfaces that the spot lies on, weighted by their shares of its width.
// A surface that returns nothing has no share. `rim` [rad] is the spot's end on the side to look at.
void LaserModel::mix(const Caster& caster, const Beam& beam, double rim, double& range) const {
  const Ray at_rim = turned(beam.ray, rim);
  const Hit other = seen(caster, at_rim, beam.angle + rim, caster.cast(at_rim));
  if (!returns(beam.hit) || !returns(other)) return;
  if (std::fabs(other.range - beam.hit.range) < kDepthEdge) return;
  double inside = 0.0;
  double outside = rim;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    const Ray between = turned(beam.ray, middle);
    const double depth = seen(caster, between, beam.angle + middle, caster.cast(between)).range;
    const bool same = std::fabs(depth - beam.hit.range) < std::fabs(depth - other.range);
    (same ? inside : outside) = middle;
  }
  range += (rim - inside) / (2.0 * rim) * (other.range - beam.hit.range);
}

void LaserModel::complete() {
  LaserScan scan{due(0), std::move(ranges_), X_RB_};
  for (std::size_t k = 0; k < scan.ranges.size(); ++k)
    scan.ranges[k] = measured(scan.ranges[k], strengths_[k]);
  completed_ = std::move(scan);
  ranges_.clear();
  strengths_.clear();
  ranges_.reserve(scanner_.count);
  scan_end_ += scanner_.period;
}

double LaserModel::measured(double range, double strength) {
  // Both are drawn for every beam, so that one more return does not shift all later noise.
  const double noise = random_.normal(0.0, errors_.laser_sigma) * std::sqrt(1.0 + kNoiseOfWeak / strength);
  const bool is_lost =
      random_.chance(std::isfinite(strength) ? portable::exp(-std::numbers::ln2 * strength) : 0.0);
  if (range >= scanner_.max_range || is_lost) return scanner_.max_range;
  double reading = range + bias_ + noise;
  if (errors_.quantised && scanner_.quantum > 0.0)
    reading = std::round(reading / scanner_.quantum) * scanner_.quantum;
  return std::clamp(reading, scanner_.min_range, scanner_.max_range);
}

}  // namespace orca::sim::detail
