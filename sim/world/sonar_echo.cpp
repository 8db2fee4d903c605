// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <utility>
#include <vector>

#include "sonar_beam.hpp"

namespace orca::sim::detail {
namespace {

constexpr int kRays = 9;
// [m] Where a mirrored ray starts off the wall that mirrors it.
constexpr double kOff = 1e-6;

// Where two edges cross, if they do.
std::optional<Vec2> crossing(const Segment& one, const Segment& other) {
  const Vec2 d = one.b - one.a;
  const Vec2 e = other.b - other.a;
  const double slope = cross(d, e);
  if (slope == 0.0) return std::nullopt;
  const double s = cross(other.a - one.a, e) / slope;
  const double t = cross(other.a - one.a, d) / slope;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return std::nullopt;
  return one.a + s * d;
}

// Collects the echoes of one cone and keeps the nearest that is strong enough.
class Listener {
 public:
  Listener(const Caster& caster, const Beam& beam, double critical_angle)
      : caster_(caster),
        beam_(beam),
        axis_(direction(beam.sensor.yaw)),
        view_(caster, beam.ray(axis_), beam.half_lobe),
        critical_tangent_(std::tan(critical_angle)) {}

  void probe_fan() {
    const double pitch = 2.0 * beam_.half_lobe / (kRays - 1);
    const Vec2 turn = direction(pitch);
    Vec2 towards = rotated(axis_, -beam_.half_lobe);
    for (int i = 0; i < kRays; ++i) {
      probe(i * pitch - beam_.half_lobe, towards);
      towards = {turn.x * towards.x - turn.y * towards.y, turn.y * towards.x + turn.x * towards.y};
    }
  }

  // What is met behind a mirror, if it sends the sound back the way it came. Only flat walls mirror.
  void probe_mirrors() {
    for (const Mirrored& m : mirrored_) {
      const auto* wall = std::get_if<Segment>(&m.hit.surface);
      if (wall == nullptr) continue;
      const Vec2 along = (1.0 / norm(wall->b - wall->a)) * (wall->b - wall->a);
      const Vec2 away = 2.0 * dot(m.ray.direction, along) * along - m.ray.direction;
      Ray second = m.ray;
      second.origin = m.ray.origin + (m.hit.range - kOff) * m.ray.direction;
      second.direction = away;
      second.max_range = beam_.max_range - m.hit.range;
      const Hit hit = caster_.cast(second);
      if (hit.found() && hit.steeper_than(critical_tangent_)) offer(m.hit.range + hit.range, m.off_axis);
    }
  }

  void probe_surfaces() {
    const Vec2 from = beam_.sensor.position();
    for (const Echo::Met& met : met_) {
      if (const auto* circle = std::get_if<Circle>(&met.surface)) {
        const Vec2 to_center = circle->center - from;
        probe_point(from + (1.0 - circle->radius / norm(to_center)) * to_center, 0.0);
      } else if (const auto* edge = std::get_if<Segment>(&met.surface)) {
        probe_foot(*edge, from);
        probe_point(edge->a, kEdgeLoss);
        probe_point(edge->b, kEdgeLoss);
      }
    }
  }

  // Where two walls meet in a corner neither needs to end: they run into each other.
  void probe_corners() {
    for (std::size_t i = 0; i < met_.size(); ++i)
      for (std::size_t k = i + 1; k < met_.size(); ++k) {
        const auto* one = std::get_if<Segment>(&met_[i].surface);
        const auto* other = std::get_if<Segment>(&met_[k].surface);
        if (one == nullptr || other == nullptr) continue;
        if (const auto corner = crossing(*one, *other)) probe_point(*corner, kEdgeLoss);
      }
  }

  [[nodiscard]] bool heard() const { return nearest_.has_value(); }
  [[nodiscard]] Echo result() && { return {nearest_, std::move(met_), reach_, std::move(view_)}; }

 private:
  // A ray of the fan: a surface met steeply enough answers; its nearest and end points are looked at
  // afterwards.
  void probe(double off_axis, Vec2 towards) {
    const Ray ray = beam_.ray(towards);
    const Hit hit = view_.cast(ray);
    reach_ = std::max(reach_, hit.range);
    if (!hit.found()) return;
    if (hit.steeper_than(critical_tangent_)) {
      offer(hit.range, off_axis);
    } else {
      mirrored_.push_back({ray, hit, off_axis});
    }
    if (std::ranges::find(met_, hit.surface, &Echo::Met::surface) == met_.end())
      met_.push_back({hit.surface, hit.element});
  }

  struct Mirrored {
    Ray ray;
    Hit hit;
    double off_axis;
  };

  // Where the surface faces the sensor, if that point is not an end: sound comes straight back from there.
  void probe_foot(const Segment& edge, Vec2 from) {
    const Vec2 foot = nearest_point(edge, from);
    if (!(foot == edge.a) && !(foot == edge.b)) probe_point(foot, 0.0);
  }
  void probe_point(Vec2 point, double loss) {
    const Vec2 w = point - beam_.sensor.position();
    const double range = norm(w);
    if (range > beam_.max_range || !nearer(range)) return;
    const double off_axis = std::atan2(cross(axis_, w), dot(axis_, w));
    if (std::fabs(off_axis) > beam_.half_lobe || !is_heard(off_axis, loss)) return;
    if (view_.cast(beam_.ray((1.0 / range) * w)).range >= range - kSeen) nearest_ = range;
  }
  void offer(double range, double off_axis) {
    if (nearer(range) && is_heard(off_axis, 0.0)) nearest_ = range;
  }
  [[nodiscard]] bool nearer(double range) const { return !nearest_ || range < *nearest_; }
  [[nodiscard]] bool is_heard(double off_axis, double loss) const {
    return 2.0 * lobe_loss(off_axis, beam_.half_lobe) + loss <= kMostLoss;
  }

  const Caster& caster_;
  const Beam& beam_;
  Vec2 axis_;
  Caster::View view_;  // Of all that lies in the cone.
  double critical_tangent_;
  std::vector<Echo::Met> met_;
  std::vector<Mirrored> mirrored_;
  std::optional<double> nearest_;
  double reach_ = 0.0;
};

}  // namespace

Echo echo_of(const Caster& caster, const Beam& beam, double critical_angle) {
  Listener listener(caster, beam, critical_angle);
  listener.probe_fan();
  listener.probe_surfaces();
  listener.probe_corners();
  if (!listener.heard()) listener.probe_mirrors();
  return std::move(listener).result();
}

}  // namespace orca::sim::detail
