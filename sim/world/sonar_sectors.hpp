// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "orca/sim/geometry.hpp"

namespace orca::sim::detail {

// A cone in the air as far as it matters whether another can have to do with it.
struct Sector {
  Vec2 tip;
  Vec2 left, right;     // Of length 1, along both rims; at most half a turn apart.
  Circle around;        // Holds it all.
  double sent = 0.0;    // [s]
  double silent = 0.0;  // [s] Its sound has left it then.
};

// Many sectors, of which all are asked for each listener: column by column and in single precision, so that
// the compiler looks at four at once. It errs on the side of finding too many. One thread at a time.
class Sectors {
 public:
  // From now on times are kept relative to `base` [s], from which they must not be farther than some seconds;
  // nothing is held any more.
  void clear(double base);
  void add(const Sector& sector);

  // The numbers, in the order in which they were added, of all sectors that may have a point in common with
  // `one`, were sent by `sent_until` and are not silent before `silent_from` [s]. Valid until the next call.
  std::span<const std::uint32_t> near(const Sector& one, double silent_from, double sent_until) const;

 private:
  enum Column { tip_x, tip_y, left_x, left_y, right_x, right_y, x, y, radius, sent, silent, kColumns };

  void mark(const Sector& one, double silent_from, double sent_until) const;

  double base_ = 0.0;
  std::array<std::vector<float>, kColumns> columns_;
  mutable std::vector<std::int32_t> marks_;  // Of near(), kept for their memory.
  mutable std::vector<std::uint32_t> found_;
};

}  // namespace orca::sim::detail
