// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/realism.hpp"
#include "rays/bearing.hpp"
#include "rays/panorama.hpp"

namespace orca::sim::detail {

// Losses say how much weaker sound is than on the axis, as the logarithm of the ratio [Np], so that they add
// up.
//
// Returns the one-way loss in a direction off the axis; both angles in [rad]. There and back the amplitude is
// a Gaussian over the angle. Its standard deviation is half of `half_lobe`: exp(-2) = 0.135 at the rim.
inline double lobe_loss(double off_axis, double half_lobe) {
  const double share = off_axis / half_lobe;
  return share * share;
}

// The opening of a transducer's cone, with what it hears there and the values that are often derived from it.
struct Lobe {
  explicit Lobe(double half, const ErrorLevels& errors = {})
      : half_angle(half),
        rim(direction(half)),
        tangent(portable::tan(half)),
        most_loss(portable::log(1.0 / errors.sonar_threshold)),
        edge_loss(-portable::log(errors.sonar_edges)),
        in_line(portable::sin(errors.sonar_in_line)),
        edge_bearing(bearing_of_edges()) {}
  double half_angle;  // [rad] At most a right angle.
  Vec2 rim;           // Direction of the left rim, of length 1, if the axis is x.
  double tangent;     // Slope of that rim.
  // [Np] Of the weakest sound that is heard: a little more than that of a smooth wall at the rim of the lobe.
  double most_loss;
  // [Np] An edge scatters a part of the sound only, so it is heard in the middle of the beam.
  double edge_loss;
  double in_line;  // Sine of the angle up to which joined edges lie in one line: nothing scatters there.
  // Bearing up to which edges are heard: there twice the loss of the lobe and that of an edge make the largest one.
  // Negative if none is heard.
  double edge_bearing;

 private:
  [[nodiscard]] double bearing_of_edges() const {
    if (edge_loss > most_loss) return -1.0;
    return bearing_of(direction(half_angle * std::fmin(1.0, std::sqrt(0.5 * (most_loss - edge_loss)))));
  }
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

  Pose2 sensor;  // Pose in the world.
  Vec2 axis;     // Direction in the world, of length 1.
  Lobe lobe;
  double min_range;  // [m] Echoes from nearer are not heard.
  double max_range;  // [m]
  double height;     // [m] Above the floor.
  std::size_t own_body;

  [[nodiscard]] Vec2 left() const { return rotated(axis, lobe.rim); }
  [[nodiscard]] Vec2 right() const { return rotated(axis, Vec2{lobe.rim.x, -lobe.rim.y}); }
  [[nodiscard]] bool holds(Vec2 towards) const {
    return std::fabs(cross(axis, towards)) <= dot(axis, towards) * lobe.tangent;
  }
  // Returns the angle [rad] from the axis to a direction, positive to the left.
  [[nodiscard]] double off_axis(Vec2 towards) const {
    return portable::atan2(cross(axis, towards), dot(axis, towards));
  }
  [[nodiscard]] Ray ray(Vec2 towards) const {
    return {sensor.position(), towards, max_range, height, own_body};
  }
};

// [m] A point of a surface is seen if the ray to it ends this close to it.
constexpr double kSeen = 1e-6;

// The echoes of a transducer's own sound, with the surfaces that the beam meets.
struct Echo {
  // A surface that the beam meets, with its number.
  struct Met {
    Surface surface;
    std::uint64_t element;
  };

  std::optional<double> range;  // [m] Distance of the first echo that is strong enough.
  std::vector<Met> met;         // All surfaces that the beam meets at the sensor's height.
  double reach = 0.0;           // [m] The beam meets nothing farther.
  Panorama seen;                // All that is seen in the cone.
};

// Computes the beam's echo without noise; only the memory of the former `echo` is used again. A surface
// mirrors the sound away if the tangent of its incidence is above `critical_tangent`. If nothing else is
// heard, what the mirrored sound meets counts, at the whole distance that the sound has gone.
void listen_for(const Caster& caster, const Beam& beam, double critical_tangent, Echo& echo);

}  // namespace orca::sim::detail
