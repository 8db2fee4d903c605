// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/odometry.hpp"

#include "orca/hw/nomad_scout/number.hpp"

namespace orca::hw::nomad_scout {

int step_of(int previous, int next) {
  constexpr int kTurn = 65536;
  const int step = next - previous;
  if (step > kTurn / 2) return step - kTurn;
  return step < -kTurn / 2 ? step + kTurn : step;
}

Vec2 ScoutOdometry::add(const RawPosition& position) {
  const RawPosition before = previous_.value_or(position);
  previous_ = position;
  return {kLengthUnit * step_of(before.x, position.x), kLengthUnit * step_of(before.y, position.y)};
}

}  // namespace orca::hw::nomad_scout
