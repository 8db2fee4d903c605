// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "sonar_beam.hpp"
#include "sonar_sectors.hpp"

namespace orca::sim::detail {

// The air that all sonars of a world share. It holds the chirps on their way: a sonar may hear another's,
// straight or off a surface that both beams meet.
class SonarAir {
 public:
  // A chirp in the air: its beam, and how far it goes.
  struct Cone {
    Cone(std::uint64_t chirp, const Beam& from, double reach, double sent_at);
    [[nodiscard]] bool holds(Vec2 towards) const { return beam.holds(towards); }
    // Returns the transducer's one-way loss [Np] in a direction within the beam.
    [[nodiscard]] double loss(Vec2 towards) const {
      return lobe_loss(beam.off_axis(towards), beam.lobe.half_angle);
    }

    std::uint64_t number;  // The chirp's number.
    Beam beam;
    double reach;  // [m]
    Sector sector;
  };

  // Adds a chirp that is sent at `time`. @return  its number.
  // @pre  settle() was called with a time near `time`, unless that is near zero.
  std::uint64_t send(TimePoint time, const Beam& beam, const Echo& echo);

  // Forgets the chirps that can no longer be heard at `now`.
  void settle(TimePoint now);

  // Returns the range [m] that the sonar which sent chirp number `own` reads, if it hears anything. It takes
  // the first sound that arrives for its echo, even if another sonar sent it. Many threads may call it at
  // once.
  // @pre  that chirp is still in the air.
  [[nodiscard]] std::optional<double> first_heard(const Caster& caster, std::uint64_t own, const Echo& echo,
                                                  Sectors::Search& search) const;

 private:
  class Ear;
  class Ways;
  // The chirps that one listener can hear, given by their times.
  struct Window {
    std::uint64_t own;   // Number of the listener's own chirp.
    double now;          // [s] Time at which that was sent.
    double silent_from;  // [s] Chirps that ended before this time can no longer reach the listener.
  };

  [[nodiscard]] const Cone& cone(std::uint64_t chirp) const { return cones_[chirp - cones_.front().number]; }
  [[nodiscard]] bool is_in(const Window& window, const Cone& cone) const;
  void forget_elements();
  template <class Visit>
  void for_all_off(std::uint64_t element, const Window& window, const Visit& visit) const;

  std::deque<Cone> cones_;  // Chirps in the air, numbered without a gap.
  // For each boundary element the numbers of the cones that meet it, oldest first. Some of these cones are no
  // longer in the air. Results do not depend on the order of the elements.
  std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> met_;
  std::size_t forget_at_ = 0;  // Number of elements at which unused ones are discarded.
  Sectors sectors_;            // Sectors of the chirps that can be heard.
  std::uint64_t sent_ = 0;
  double farthest_ = 0.0;  // [m] Largest range of any sonar.
};

}  // namespace orca::sim::detail
