// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sonar_beam.hpp"

namespace orca::sim::detail {

// All sonars of a world share the air: what one sends, another may hear.
class SonarAir {
 public:
  // A beam as far as it goes.
  struct Cone {
    Cone(std::uint64_t chirp, const Beam& from, double reach);
    [[nodiscard]] bool holds(Vec2 towards) const {
      return std::fabs(cross(axis, towards)) <= dot(axis, towards) * tan_lobe;
    }
    // False if the circle lies beside the cone, on either side; true also for some that do.
    [[nodiscard]] bool may_hold(const Circle& circle) const {
      const Vec2 to = circle.center - beam.sensor.position();
      return cross(left, to) <= circle.radius && cross(right, to) >= -circle.radius;
    }
    // Strength of the transducer in a direction that it holds, on one way: squared, it is what its own echo
    // has from there (sonar_echo.cpp).
    [[nodiscard]] double strength(Vec2 towards) const;

    std::uint64_t number;  // Of the chirp.
    Beam beam;
    double reach;            // [m]
    Vec2 axis, left, right;  // Of length 1: in the middle and along both rims.
    double tan_lobe;
    Circle around;  // Holds it all.
  };

  // @param reach  [m] of the beam's own echo.
  // @return  the chirp's number.
  std::uint64_t send(TimePoint time, const Beam& beam, double reach);

  // Forgets what can no longer be heard at `now`.
  void settle(TimePoint now);

  // What `listener` reads [m], if it hears anything: it has sent chirp number `own` at `since` and takes
  // whatever comes first for its echo, be it that echo or another's sound.
  [[nodiscard]] std::optional<double> first_heard(const Caster& caster, const Beam& listener,
                                                  std::uint64_t own, TimePoint since, const Echo& echo) const;

 private:
  // What tells of most chirps that they cannot be heard; small, since every listener looks at all of them.
  struct Chirp {
    double sent;    // [s]
    double silent;  // [s] It is out of its own cone then: it is heard only within the listener's.
    Circle around;  // Holds its cone.
  };
  void find_near(const Circle& circle, double silent_from, double sent_until) const;

  std::vector<Chirp> chirps_;  // In the air, tick by tick;
  std::vector<Cone> cones_;    // and their cones.
  std::uint64_t sent_ = 0;
  double farthest_ = 0.0;                    // [m] That any sonar hears.
  mutable std::vector<std::uint32_t> near_;  // Of first_heard(), kept for its memory.
};

}  // namespace orca::sim::detail
