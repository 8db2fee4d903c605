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

// All sonars of a world share the air: what one sends, another may hear, straight or off a surface that both
// beams meet.
class SonarAir {
 public:
  // A beam as far as it goes.
  struct Cone {
    Cone(std::uint64_t chirp, const Beam& from, double reach, double sent_at);
    [[nodiscard]] bool holds(Vec2 towards) const { return beam.holds(towards); }
    // Of the transducer in a direction that it holds, on one way.
    [[nodiscard]] double loss(Vec2 towards) const {
      return lobe_loss(beam.off_axis(towards), beam.lobe.half_angle);
    }

    std::uint64_t number;  // Of the chirp.
    Beam beam;
    double reach;  // [m]
    Sector sector;
  };

  // @pre  settle() with a time near `time`, unless that is near zero.
  // @return  the chirp's number.
  std::uint64_t send(TimePoint time, const Beam& beam, const Echo& echo);

  // Forgets what can no longer be heard at `now`.
  void settle(TimePoint now);

  // Returns what the sonar that has sent chirp number `own` reads [m], if it hears anything. It takes the first sound
  // that arrives for its echo, even if another sonar sent it. Several threads may ask at once.
  // @pre  that chirp is still in the air.
  [[nodiscard]] std::optional<double> first_heard(const Caster& caster, std::uint64_t own, const Echo& echo,
                                                  Sectors::Search& search) const;

 private:
  class Ear;
  class Ways;
  // What a listener can hear.
  struct Window {
    std::uint64_t own;   // The chirp that is its own.
    double now;          // [s] When it has sent that.
    double silent_from;  // [s] Chirps that ended before this can no longer reach it.
  };

  [[nodiscard]] const Cone& cone(std::uint64_t chirp) const { return cones_[chirp - cones_.front().number]; }
  [[nodiscard]] bool is_in(const Window& window, const Cone& cone) const;
  void forget_elements();
  template <class Visit>
  void for_all_off(std::uint64_t element, const Window& window, const Visit& visit) const;

  std::deque<Cone> cones_;  // In the air, numbered without a gap.
  // By the elements that they meet: numbers of cones in the air and of some that no longer are, the oldest
  // first. Nothing depends on the order of the elements.
  std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> met_;
  std::size_t forget_at_ = 0;  // So many elements are too many.
  Sectors sectors_;            // Of those that can be heard.
  std::uint64_t sent_ = 0;
  double farthest_ = 0.0;  // [m] That any sonar hears.
};

}  // namespace orca::sim::detail
