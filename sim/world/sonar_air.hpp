// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "sonar_beam.hpp"

namespace orca::sim::detail {

// All sonars of a world share the air: what one sends, another may hear.
class SonarAir {
 public:
  // A beam as far as it goes.
  struct Cone {
    Cone(const Beam& from, double reach);
    // Strength of the transducer in a direction, on one way: squared, it is what its own echo has from there
    // (sonar_echo.cpp).
    [[nodiscard]] double strength(Vec2 towards) const;

    Beam beam;
    Vec2 axis;
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
  struct Chirp {
    std::uint64_t number;
    TimePoint time;
    Cone cone;
  };

  std::deque<Chirp> chirps_;
  std::uint64_t sent_ = 0;
};

}  // namespace orca::sim::detail
