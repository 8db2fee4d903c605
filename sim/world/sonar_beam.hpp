// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/sim/caster.hpp"

namespace orca::sim::detail {

// The cone of one transducer at the moment it fires.
struct Beam {
  Pose2 sensor;            // In the world.
  double half_lobe = 0.0;  // [rad]
  double min_range = 0.0;  // [m] It is deaf to what comes back sooner.
  double max_range = 0.0;  // [m]
  double height = 0.0;     // [m]
  std::size_t own_body = 0;

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

  std::optional<double> range;  // [m] From where the first comes back that is strong enough.
  std::vector<Met> met;         // All that the beam meets.
  double reach = 0.0;           // [m] It meets nothing farther.
  Caster::View view;            // Of the cone, until something moves.
};

// The first echo, without noise. Surfaces met at more than `critical_angle` [rad] mirror the sound away; if
// nothing else is heard, what it meets behind such a mirror counts, as far as the sound has gone.
[[nodiscard]] Echo echo_of(const Caster& caster, const Beam& beam, double critical_angle);

}  // namespace orca::sim::detail
