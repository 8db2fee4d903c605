// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "sonar_beam.hpp"

namespace orca::sim::detail {

// The part of a cone in the air that decides whether it faces another cone.
struct Sector {
  Sector(const Beam& beam, double sent_at, double silent_at)
      : tip(beam.sensor.position()),
        left(beam.left()),
        right(beam.right()),
        yaw(wrapped(beam.sensor.yaw)),
        half_angle(beam.lobe.half_angle),
        sent(sent_at),
        silent(silent_at) {}

  Vec2 tip;
  Vec2 left, right;   // Directions of both rims, of length 1.
  double yaw;         // [rad] Direction of the axis in the world, in (-pi, pi].
  double half_angle;  // [rad] At most a right angle.
  double sent;        // [s] Time at which the sound was sent.
  double silent;      // [s] Time at which the sound has left the cone.
};

// A set of sectors, sorted by direction, that each listener searches. Its columns are in single precision, so
// that the compiler handles four sectors at once. Rounding may add sectors to a result, but never removes
// one.
class Sectors {
 public:
  // Removes all sectors. Later times are stored relative to `base` [s] and must be within some seconds of it.
  void clear(double base);
  void add(const Sector& sector, std::uint64_t number);

  // The working memory of a search. Callers that search often keep it.
  struct Search {
    std::vector<std::int32_t> marks;
    std::vector<std::uint64_t> found;
  };
  // Returns the numbers, in no order, of all sectors that contain the tip of `one` and whose tip `one`
  // contains. They were sent by `sent_until` [s] and are not silent before `silent_from` [s]. The result is
  // valid until the next search with the same `search`.
  std::span<const std::uint64_t> facing(const Sector& one, double silent_from, double sent_until,
                                        Search& search) const;

 private:
  enum Column { tip_x, tip_y, left_x, left_y, right_x, right_y, margin, sent, silent, kColumns };
  // The sectors with about the same direction.
  struct Bin {
    std::array<std::vector<float>, kColumns> columns;
    std::vector<std::uint64_t> numbers;
  };
  static constexpr int kBins = 16;

  // The search request in the precision of the columns.
  struct Question {
    float x, y, left_x, left_y, right_x, right_y, margin, silent_from, sent_until;
  };

  static void mark(const Bin& bin, const Question& asked, std::int32_t* marks);

  double base_ = 0.0;
  double widest_ = 0.0;  // [rad] Largest half angle of any sector.
  std::array<Bin, kBins> bins_;
};

}  // namespace orca::sim::detail
