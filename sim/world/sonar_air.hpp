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
  struct Chirp {
    std::uint64_t number;
    TimePoint time;
    Beam beam;
  };

  // @return  the chirp's number.
  std::uint64_t send(TimePoint time, const Beam& beam);

  // Forgets what can no longer be heard at `now`.
  void settle(TimePoint now);

  // The nearest range that `listener` takes another's sound for [m], if it hears any: the listener has sent
  // chirp number `own` at `since` and takes whatever comes back for its echo.
  [[nodiscard]] std::optional<double> stray(const Caster& caster, const Beam& listener, std::uint64_t own,
                                            TimePoint since, const std::vector<Surface>& surfaces) const;

 private:
  std::deque<Chirp> chirps_;
  std::uint64_t sent_ = 0;
};

}  // namespace orca::sim::detail
