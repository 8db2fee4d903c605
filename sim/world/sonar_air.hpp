// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

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
    [[nodiscard]] bool holds(Vec2 towards) const {
      return std::fabs(cross(axis, towards)) <= dot(axis, towards) * tan_lobe;
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
  // @return  the chirp's number.
  std::uint64_t send(TimePoint time, const Beam& beam, const Echo& echo);

  // Forgets what can no longer be heard at `now`.
  void settle(TimePoint now);

  // What `listener` reads [m], if it hears anything: it has sent chirp number `own` at `since` and takes
  // whatever comes first for its echo, be it that echo or another's sound. Many listeners at once.
  [[nodiscard]] std::optional<double> first_heard(const Caster& caster, const Beam& listener,
                                                  std::uint64_t own, TimePoint since, const Echo& echo,
                                                  Sectors::Search& search) const;

 private:
  class Ear;
  class Ways;
  // What a listener can hear.
  struct Window {
    std::uint64_t own;   // The chirp that is its own.
    double now;          // [s] When it has sent that.
    double silent_from;  // [s] What is silent before that cannot come to it any more.
  };

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
