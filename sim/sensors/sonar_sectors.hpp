// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "sonar_beam.hpp"

namespace orca::sim::detail {

// A cone in the air as far as it matters whether it faces another.
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
  Vec2 left, right;   // Of length 1, along both rims.
  double yaw;         // [rad] Of the axis, in (-pi, pi].
  double half_angle;  // [rad] At most a right angle.
  double sent;        // [s]
  double silent;      // [s] Its sound has left it then.
};

// Many sectors, which are asked for by each listener: sorted by where they look, column by column and in
// single precision, so that the compiler looks at four at once. It errs on the side of finding too many.
class Sectors {
 public:
  // From now on times are kept relative to `base` [s], from which they must not be farther than some seconds;
  // nothing is held any more.
  void clear(double base);
  void add(const Sector& sector, std::uint64_t number);

  // What a search needs; kept by who asks often, for its memory.
  struct Search {
    std::vector<std::int32_t> marks;
    std::vector<std::uint64_t> found;
  };
  // The numbers, in no order, of all sectors that hold the tip of `one` and whose tip it holds, that were
  // sent by `sent_until` and are not silent before `silent_from` [s]. Valid until the next search.
  std::span<const std::uint64_t> facing(const Sector& one, double silent_from, double sent_until,
                                        Search& search) const;

 private:
  enum Column { tip_x, tip_y, left_x, left_y, right_x, right_y, margin, sent, silent, kColumns };
  // Those that look about one way.
  struct Bin {
    std::array<std::vector<float>, kColumns> columns;
    std::vector<std::uint64_t> numbers;
  };
  static constexpr int kBins = 16;

  // What is asked for, as the columns have it.
  struct Question {
    float x, y, left_x, left_y, right_x, right_y, margin, silent_from, sent_until;
  };

  static void mark(const Bin& bin, const Question& asked, std::int32_t* marks);

  double base_ = 0.0;
  double widest_ = 0.0;  // [rad] Half angle.
  std::array<Bin, kBins> bins_;
};

}  // namespace orca::sim::detail
