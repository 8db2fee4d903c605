// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "sonar_beam.hpp"

namespace orca::sim::detail {
namespace {

constexpr int kEchoRays = 9;
// [m] Distance from a mirroring wall at which the mirrored ray starts.
constexpr double kOff = 1e-6;

// Returns the point where two edges cross, if they do.
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
  Listener(const Caster& caster, const Beam& beam, double critical_tangent, Echo& echo)
      : caster_(caster), beam_(beam), critical_tangent_(critical_tangent), echo_(echo) {
    echo.range.reset();
    echo.met.clear();
    echo.mirrored.clear();
    echo.reach = 0.0;
    echo.view.look(caster, beam.ray(beam.axis), beam.lobe.half_angle);
  }

  void probe_fan() {
    const double pitch = 2.0 * beam_.lobe.half_angle / (kEchoRays - 1);
    const Vec2 turn = direction(pitch);
    Vec2 towards = beam_.right();
    for (int i = 0; i < kEchoRays; ++i) {
      probe(i * pitch - beam_.lobe.half_angle, towards);
      towards = rotated(towards, turn);
    }
  }

  // Looks for surfaces behind a mirror that send the sound back the way it came. Only flat walls mirror.
  void probe_mirrors() {
    for (const Echo::Mirrored& m : echo_.mirrored) {
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
    for (const Echo::Met& met : echo_.met) {
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

  // Looks for corners between walls. Neither wall needs to end there: they may run into each other.
  void probe_corners() {
    for (std::size_t i = 0; i < echo_.met.size(); ++i)
      for (std::size_t k = i + 1; k < echo_.met.size(); ++k) {
        const auto* one = std::get_if<Segment>(&echo_.met[i].surface);
        const auto* other = std::get_if<Segment>(&echo_.met[k].surface);
        if (one == nullptr || other == nullptr) continue;
        if (const auto corner = crossing(*one, *other)) probe_point(*corner, kEdgeLoss);
      }
  }

 private:
  // Casts one ray of the fan. A surface that it meets steeply enough answers; the surface's nearest point and
  // ends are examined afterwards.
  void probe(double off_axis, Vec2 towards) {
    const Ray ray = beam_.ray(towards);
    const Hit hit = echo_.view.cast(ray);
    echo_.reach = std::max(echo_.reach, hit.range);
    if (!hit.found()) return;
    if (hit.steeper_than(critical_tangent_)) {
      offer(hit.range, off_axis);
    } else {
      echo_.mirrored.push_back({ray, hit, off_axis});
    }
    if (std::ranges::find(echo_.met, hit.surface, &Echo::Met::surface) == echo_.met.end())
      echo_.met.push_back({hit.surface, hit.element});
  }

  // Examines the point where the surface faces the sensor, if it is not an end: sound comes straight back
  // from it.
  void probe_foot(const Segment& edge, Vec2 from) {
    const Vec2 foot = nearest_point(edge, from);
    if (!(foot == edge.a) && !(foot == edge.b)) probe_point(foot, 0.0);
  }
  void probe_point(Vec2 point, double loss) {
    const Vec2 w = point - beam_.sensor.position();
    const double range = norm(w);
    if (range > beam_.max_range || !nearer(range)) return;
    if (!beam_.holds(w) || !is_heard(beam_.off_axis(w), loss)) return;
    if (echo_.view.cast(beam_.ray((1.0 / range) * w)).range >= range - kSeen) echo_.range = range;
  }
  void offer(double range, double off_axis) {
    if (nearer(range) && is_heard(off_axis, 0.0)) echo_.range = range;
  }
  [[nodiscard]] bool nearer(double range) const { return !echo_.range || range < *echo_.range; }
  [[nodiscard]] bool is_heard(double off_axis, double loss) const {
    return 2.0 * lobe_loss(off_axis, beam_.lobe.half_angle) + loss <= kMostLoss;
  }

  const Caster& caster_;
  const Beam& beam_;
  double critical_tangent_;
  Echo& echo_;
};

}  // namespace

void listen_for(const Caster& caster, const Beam& beam, double critical_tangent, Echo& echo) {
  Listener listener(caster, beam, critical_tangent, echo);
  listener.probe_fan();
  listener.probe_surfaces();
  listener.probe_corners();
  if (!echo.range) listener.probe_mirrors();
}

}  // namespace orca::sim::detail
