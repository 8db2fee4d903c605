// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wheel_grip.hpp"

namespace orca::sim::detail {
namespace {

constexpr int kRows = 3;

btVector3 flat(Vec2 v) { return {v.x, v.y, 0.0}; }

}  // namespace

void WheelGrip::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = kRows;
  info->nub = 0;
}

void WheelGrip::getInfo2(btConstraintInfo2* info) {
  const Vec2 ahead = direction(grip_.heading);
  const Vec2 left{-ahead.y, ahead.x};
  const auto row = [&](int number, double wanted, double drives, double holds) {
    const int at = number * info->rowskip;
    info->m_constraintError[at] = wanted;
    info->m_lowerLimit[at] = -seconds_ * (wanted < 0.0 ? drives : holds);
    info->m_upperLimit[at] = seconds_ * (wanted > 0.0 ? drives : holds);
    return at;
  };
  const auto linear = [&](int at, Vec2 axis) {
    const btVector3 a = flat(axis);
    for (int k = 0; k < 3; ++k) info->m_J1linearAxis[at + k] = a[k];
  };
  const double across = grip_.rolls_sideways ? grip_.drives : grip_.slides;
  linear(row(0, dot(ahead, grip_.velocity), grip_.drives, grip_.slides), ahead);
  linear(row(1, dot(left, grip_.velocity), across, grip_.slides), left);
  info->m_J1angularAxis[row(2, grip_.turn, grip_.turns, grip_.turns) + 2] = 1.0;
}

}  // namespace orca::sim::detail
