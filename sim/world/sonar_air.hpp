// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sonar_beam.hpp"
#include "sonar_sectors.hpp"

namespace orca::sim::detail {

// All sonars of a world share the air: what one sends, another may hear.
class SonarAir {
 public:
  // A beam as far as it goes.
  struct Cone {
    Cone(std::uint64_t chirp, const Beam& from, double reach, double sent_at);
    [[nodiscard]] bool holds(Vec2 towards) const {
      return std::fabs(cross(axis, towards)) <= dot(axis, towards) * tan_lobe;
    }
    // False if the circle lies beside the cone, on either side; true also for some that do.
    [[nodiscard]] bool may_hold(const Circle& circle) const {
      const Vec2 to = circle.center - sector.tip;
      return cross(sector.left, to) <= circle.radius && cross(sector.right, to) >= -circle.radius;
    }
    // Of the transducer in a direction that it holds, on one way.
    [[nodiscard]] double loss(Vec2 towards) const;

    std::uint64_t number;  // Of the chirp.
    Beam beam;
    double reach;  // [m]
    Vec2 axis;     // Of length 1.
    double tan_lobe;
    Sector sector;
  };

  // @pre  settle() with a time near `time`, unless that is near zero.
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
  std::vector<Cone> cones_;  // In the air, tick by tick;
  Sectors sectors_;          // and what tells of most of them that they cannot be heard.
  std::uint64_t sent_ = 0;
  double farthest_ = 0.0;  // [m] That any sonar hears.
};

}  // namespace orca::sim::detail
