// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/hw/nomad_scout/state.hpp"

namespace orca::hw::nomad_scout {

/// Returns the step from one raw coordinate to the next. A step of more than half of all coordinates is taken for a wrap at
/// the end of 16 bits; whether a Scout wraps or stays at the end is not documented.
[[nodiscard]] int step_of(int previous, int next);

/// The way of a Scout, out of the positions in its answers. These end after 83 m, so only their differences
/// count.
///
/// Thread contract: not synchronised.
class ScoutOdometry {
 public:
  /// Returns how far the robot has come since the last call [m], in the frame of its odometry; {0, 0} after the first one.
  Vec2 add(const RawPosition& position);

  /// Makes the next position a new reference: after the connection was opened again, or define_position().
  void forget() { previous_.reset(); }

 private:
  std::optional<RawPosition> previous_;
};

}  // namespace orca::hw::nomad_scout
