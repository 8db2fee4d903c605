// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

namespace orca::fuse {

/// The movement that one behaviour wants.
struct Wish {
  enum class Kind { direction, turn_rate };
  Kind kind = Kind::direction;
  double value = 0.0;   ///< Direction [rad] or turn rate [rad/s], counter-clockwise positive.
  double speed = 0.0;   ///< [m/s]
  double weight = 0.0;  ///< [1] above 0.
};

/// The one command that several wishes result in.
struct Fused {
  Wish command;                ///< Its weight is the sum of those that made it.
  std::vector<double> shares;  ///< [1] of each wish in it, in their order; the sum is 1.
};

}  // namespace orca::fuse
