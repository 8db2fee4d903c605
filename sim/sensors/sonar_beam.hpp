// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"

namespace orca::sim::detail {

// How far a transducer's cone opens, with what is asked of that again and again.
struct Lobe {
  explicit Lobe(double half) : half_angle(half), rim(direction(half)), tangent(std::tan(half)) {}
  double half_angle;  // [rad] At most a right angle.
  Vec2 rim;           // On the left, of length 1, if the axis is x;
  double tangent;     // and its slope.
};

// The cone of one transducer at the moment it fires.
struct Beam {
  Beam(const Pose2& X_WS, const Lobe& opening, double from, double to, double above_floor, std::size_t body)
      : sensor(X_WS),
        axis(direction(X_WS.yaw)),
        lobe(opening),
        min_range(from),
        max_range(to),
        height(above_floor),
        own_body(body) {}

  Pose2 sensor;  // In the world.
  Vec2 axis;     // Of length 1.
  Lobe lobe;
  double min_range;  // [m] It is deaf to what comes back sooner.
  double max_range;  // [m]
  double height;     // [m]
  std::size_t own_body;

  [[nodiscard]] Vec2 left() const { return rotated(axis, lobe.rim); }
  [[nodiscard]] Vec2 right() const { return rotated(axis, Vec2{lobe.rim.x, -lobe.rim.y}); }
  [[nodiscard]] bool holds(Vec2 towards) const {
    return std::fabs(cross(axis, towards)) <= dot(axis, towards) * lobe.tangent;
  }
  // [rad] To the left.
  [[nodiscard]] double off_axis(Vec2 towards) const {
    return std::atan2(cross(axis, towards), dot(axis, towards));
  }
  [[nodiscard]] Ray ray(Vec2 towards) const {
    return {sensor.position(), towards, max_range, height, own_body};
  }
};

// How much weaker than on the axis sound is, as the logarithm of the ratio [Np]: losses add up.
// What is lost in a direction off the axis, on one way. There and back that is a Gaussian over the angle
// whose deviation is half the half lobe: exp(-2) = 0.135 at the rim.
inline double lobe_loss(double off_axis, double half_lobe) {
  const double share = off_axis / half_lobe;
  return share * share;
}
// A tenth is still heard: a smooth wall at the rim of the lobe just so.
inline const double kMostLoss = std::log(10.0);
// An edge scatters three tenths of the sound only, so it is heard in the middle of the beam only.
inline const double kEdgeLoss = -std::log(0.3);
// [m] A point of a surface is seen if the ray to it ends this close to it.
constexpr double kSeen = 1e-6;

// What there is to hear of a transducer's own sound.
struct Echo {
  // A surface that the beam meets, with its number.
  struct Met {
    Surface surface;
    std::uint64_t element;
  };

  // A ray of the beam that a surface mirrors away.
  struct Mirrored {
    Ray ray;
    Hit hit;
    double off_axis;  // [rad]
  };

  std::optional<double> range;     // [m] From where the first comes back that is strong enough.
  std::vector<Met> met;            // All that the beam meets.
  std::vector<Mirrored> mirrored;  // Of the rays that tell what it meets.
  double reach = 0.0;              // [m] It meets nothing farther.
  Caster::View view;               // Of the cone, until something moves.
};

// Makes `echo` the first one, without noise; what it was before is used for its memory only. Surfaces met at
// an angle of more than this tangent mirror the sound away; if nothing else is heard, what it meets behind
// such a mirror counts, as far as the sound has gone.
void listen_for(const Caster& caster, const Beam& beam, double critical_tangent, Echo& echo);

}  // namespace orca::sim::detail
