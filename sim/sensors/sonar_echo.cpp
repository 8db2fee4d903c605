// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "sonar_beam.hpp"

namespace orca::sim::detail {
namespace {

using Patch = Panorama::Patch;

constexpr int kBounceRays = 9;
// [m] Distance from a mirroring wall at which the mirrored ray starts.
constexpr double kOff = 1e-6;
// [m] Surfaces that are less apart are joined: an eighth of the length of the sound, 7 mm at 49 kHz.
constexpr double kJoint = 1e-3;

// Returns true if the other edge reaches beyond the end of the one.
bool goes_beyond(const Boundary& one, const Boundary& other, Vec2 end) {
  if (norm(other.nearest_to(end) - end) > kJoint) return false;
  const Vec2 outwards = end - one.middle();
  const double beyond = std::max(dot(other.a() - end, outwards), dot(other.b() - end, outwards));
  return beyond > kJoint * norm(outwards);
}

// Collects the echoes of one cone and keeps the nearest that is strong enough.
class Listener {
 public:
  Listener(const Caster& caster, const Beam& beam, double critical_tangent, Echo& echo)
      : caster_(caster), beam_(beam), critical_tangent_(critical_tangent), echo_(echo), seen_(echo.seen) {
    echo.range.reset();
    echo.met.clear();
    caster.survey(beam.ray(beam.axis), beam.lobe.half_angle, seen_);
    echo.reach = std::min(beam.max_range, seen_.far());
  }

  // Lists what other sonars' sound may come off.
  void list_surfaces() {
    const auto patches = seen_.patches();
    for (auto patch = patches.begin(); patch != patches.end(); ++patch)
      if (patch->what != Panorama::kNothing && std::find_if(patches.begin(), patch, [&](const Patch& p) {
                                                 return p.what == patch->what;
                                               }) == patch)
        echo_.met.push_back({seen_.surface(*patch), seen_.element(*patch)});
  }

  void hear_all() {
    do {
      for (const Patch& patch : seen_.patches())
        if (seen_.is_of_level(patch)) hear_face(patch);
      for (std::size_t i = 1; i < seen_.patches().size(); ++i)
        hear_edge(seen_.patches()[i - 1], seen_.patches()[i]);
    } while (seen_.next_level());
  }

  // Looks for surfaces behind a mirror that send the sound back the way it came. Only flat walls mirror.
  void hear_bounces() {
    const double rim = bearing_of(beam_.lobe.rim);
    for (int i = 0; i < kBounceRays; ++i) hear_bounce(rim * (2.0 * i / (kBounceRays - 1) - 1.0));
  }

 private:
  // Looks for the nearest of the points at which a surface answers: where it faces the sensor, or else where it is
  // met as steeply as in no other place of the patch, at one of its ends. Faces are heard in the whole lobe.
  void hear_face(const Patch& patch) {
    const Boundary& face = seen_.boundary(patch);
    if (!nearer(in_space(face.nearest()))) return;
    if (Stretch{patch.from, patch.to}.holds(bearing_of(face.foot()))) offer(face.foot());
    for (const double end : {patch.from, patch.to})
      if (face.is_steep(end, critical_tangent_)) offer(face.at(end));
  }

  // Looks for an edge between two neighbouring patches: a corner where two walls meet, or the end of the nearer one.
  void hear_edge(const Patch& right, const Patch& left) {
    const double bearing = right.to;
    if (std::fabs(bearing) > beam_.lobe.edge_bearing) return;
    const bool right_is_nearer = depth(right, bearing) < depth(left, bearing);
    const Patch& near = right_is_nearer ? right : left;
    const Patch& other = right_is_nearer ? left : right;
    if (!is_edge(near)) return;
    const Vec2 point = seen_.boundary(near).at(bearing);
    if (!nearer(in_space(norm(point)))) return;
    const bool joined = is_edge(other) && norm(seen_.boundary(other).at(bearing) - point) <= kJoint;
    if (!seen_.is_of_level(near) && !(joined && seen_.is_of_level(other))) return;
    if (joined ? !in_line(seen_.boundary(near), seen_.boundary(other)) : is_free_end(near, bearing, point))
      offer(point);
  }

  // Returns true if the patch ends with its edge, and no other edge goes on from there in the same line.
  [[nodiscard]] bool is_free_end(const Patch& patch, double bearing, Vec2 point) const {
    const Boundary& edge = seen_.boundary(patch);
    return edge.ends_at(bearing) && std::ranges::none_of(seen_.patches(), [&](const Patch& other) {
             return is_edge(other) && other.what != patch.what && in_line(edge, seen_.boundary(other)) &&
                    goes_beyond(edge, seen_.boundary(other), point);
           });
  }

  [[nodiscard]] bool in_line(const Boundary& one, const Boundary& other) const {
    const Vec2 a = one.along();
    const Vec2 b = other.along();
    const double turn = cross(a, b);
    const double most = beam_.lobe.in_line;
    return turn * turn <= most * most * dot(a, a) * dot(b, b);
  }

  // Follows the sound that a wall mirrors away.
  void hear_bounce(double bearing) {
    const Patch& patch = seen_.first_patch_at(bearing);
    if (!is_edge(patch)) return;
    const Boundary& wall = seen_.boundary(patch);
    const Vec2 along = (1.0 / norm(wall.along())) * wall.along();
    const Vec2 point = wall.at(bearing);
    const double length = norm(point);
    const Vec2 forth = (1.0 / length) * point;
    Ray second = beam_.ray(seen_.in_world(2.0 * dot(forth, along) * along - forth));
    second.origin = beam_.sensor.position() + seen_.in_world((length - kOff) * forth);
    second.max_range = beam_.max_range - length;
    const Hit hit = caster_.cast(second);
    const double range = length + hit.range;
    if (hit.found() && hit.steeper_than(critical_tangent_) && nearer(range)) echo_.range = range;
  }

  [[nodiscard]] bool is_edge(const Patch& patch) const {
    return patch.what != Panorama::kNothing && seen_.boundary(patch).is_edge();
  }
  [[nodiscard]] double depth(const Patch& patch, double bearing) const {
    return patch.what == Panorama::kNothing ? std::numeric_limits<double>::infinity()
                                            : seen_.boundary(patch).depth(towards(bearing));
  }
  // Returns the length of the way to something at a distance in the plane, up or down to the level that is heard.
  [[nodiscard]] double in_space(double distance) const {
    return seen_.rise() == 0.0 ? distance : norm({distance, seen_.rise()});
  }
  void offer(Vec2 point) {
    const double range = in_space(norm(point));
    if (nearer(range)) echo_.range = range;
  }
  [[nodiscard]] bool nearer(double range) const {
    return range <= beam_.max_range && (!echo_.range || range < *echo_.range);
  }
  const Caster& caster_;
  const Beam& beam_;
  double critical_tangent_;
  Echo& echo_;
  Panorama& seen_;
};

}  // namespace

void listen_for(const Caster& caster, const Beam& beam, double critical_tangent, Echo& echo) {
  Listener listener(caster, beam, critical_tangent, echo);
  listener.list_surfaces();
  listener.hear_all();
  if (!echo.range) listener.hear_bounces();
}

}  // namespace orca::sim::detail
