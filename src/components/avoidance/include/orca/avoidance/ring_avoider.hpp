// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>

#include "orca/avoidance/avoider.hpp"
#include "orca/avoidance/ring_ear.hpp"
#include "orca/geometry/objects/own_beams.hpp"

namespace orca::avoid {

/// The common part of avoid behaviours that listen to a ring of sensors, each of which measures one range at its own moment.
///
/// @tparam Round  the object of the ring: SonarRangeReadings or InfraredRangeReadings.
///
/// Thread contract: as every component.
template <class Round>
class RingAvoider : public Avoider {
 protected:
  /// The names of the sensors, for people.
  struct Words {
    const char* port;      ///< "sonar"
    const char* one;       ///< "sonar"
    const char* has_done;  ///< The deed of one, done: "fired".
    const char* notice;    ///< The deed of several: "hear".
  };
  RingAvoider(ComponentHost& host, const Manner& manner, const Words& words)
      : Avoider(host, manner),
        words_(words),
        ring_(*this, words.port, {.text = "Readings of the " + std::string(words.one) + "s."}) {}

 private:
  PushProxyHandle& sensor() override { return ring_; }
  [[nodiscard]] const ObjectType& sensed() const override { return object_type<Round>(); }

  Status start() override {
    ear_.clear();
    return Avoider::start();
  }

  // Sensors may measure one after the other, and the robot moves meanwhile.
  bool listen(EchoMemory& memory) override {
    const auto readings = ring_.get_update();
    if (!is_valid(*readings) || !is_valid(*readings, check_looks_ahead(*readings)) ||
        !is_valid(*readings, check_view_ahead(*readings)) || !measures(*readings))
      return false;
    ear_.take(*readings, now(), !remembers(),
              [&](Vec2 echo, TimePoint fired) { memory.hear(moved_since(echo, age_of(fired)), keep()); });
    return true;
  }

  // Returns whether a sensor has measured lately. A base reports its ring even if the sensors are off.
  bool measures(const Round& readings) {
    const auto last = RingEar::last_firing(readings);
    return !last ||
           is_valid(readings, check_firing(age_of(*last), deaf_after(), words_.one, words_.has_done));
  }

  [[nodiscard]] std::string what_holds() override {
    const auto round = ring_.latest();
    if (!round) return {};
    const auto near =
        std::ranges::count_if(round->ranges(), [&](double range) { return range <= round->min_range(); });
    if (near == 0) return {};
    return std::to_string(near) + " of the " + std::to_string(round->ranges().size()) + " " + words_.one +
           "s of \"" + round->origin() + "\" " + words_.notice + " something nearer than they can measure";
  }

  Advice advice(const EchoMemory& memory, const Situation& situation, const Limits& limits) override {
    Limits mine = limits;
    mine.side_distance = *side_distance_;
    return avoid(memory.echoes(), situation, mine);
  }

  const Words words_;
  Param<double> side_distance_{
      *this,
      "side_distance",
      0.2,
      {.unit = "m",
       .min = 0.0,
       .text = "An echo nearer to the robot's circle than this counts as a wall across its beam."}};
  PushProxy<Round> ring_;
  RingEar ear_;
};

}  // namespace orca::avoid
