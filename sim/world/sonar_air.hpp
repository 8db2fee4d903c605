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
    Cone(const Beam& from, double reach);
    [[nodiscard]] bool holds(Vec2 towards) const {
      return std::fabs(cross(axis, towards)) <= dot(axis, towards) * tan_lobe;
    }
    // Strength of the transducer in a direction that it holds, on one way: squared, it is what its own echo
    // has from there (sonar_echo.cpp).
    [[nodiscard]] double strength(Vec2 towards) const;

    Beam beam;
    double reach;  // [m]
    Vec2 axis;
    double tan_lobe;
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
    TimePoint time;
    Circle around;  // Holds the cone.
  };

  std::vector<Chirp> chirps_;  // In the air, tick by tick;
  std::vector<Cone> cones_;    // their cones,
  std::uint64_t first_ = 0;    // and the first one's number.
};

}  // namespace orca::sim::detail
