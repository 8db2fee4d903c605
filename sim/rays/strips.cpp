// SPDX-License-Identifier: LGPL-3.0-or-later
#include "strips.hpp"

namespace orca::sim::detail {

Strips::Strips(const Cells& cells, const Cone& cone) : cells_(&cells) {
  if (cells.count() == 0) return;
  by_columns_ = std::fabs(cone.axis.x) >= std::fabs(cone.axis.y);
  step_ = along(cone.axis) > 0.0 ? 1 : -1;
  const auto [low, high] = std::minmax(
      {aside(cone.left) / std::fabs(along(cone.left)), aside(cone.right) / std::fabs(along(cone.right))});
  low_ = low;
  high_ = high;
  aside_ = 2.0 * cone.slack * (1.0 + std::max(-low_, high_)) + 2.0 * Cells::kMargin;
  slack_ = cone.slack + 2.0 * Cells::kMargin;
  const bool straight = low_ < 0.0 && high_ > 0.0;
  slowness_ = straight ? 1.0 : 1.0 / std::max(std::fabs(along(cone.left)), std::fabs(along(cone.right)));
  tip_along_ = along(cone.tip);
  tip_across_ = aside(cone.tip);
  const double start = tip_along_ - step_ * slack_;
  strips_ = by_columns_ ? cells.columns() : cells.rows();
  strip_ = by_columns_ ? cells.column(start) : cells.row(start);
  const int nearer_side = step_ > 0 ? strip_ : strip_ + 1;
  entry_ = step_ * (along(cells.low(nearer_side, nearer_side)) - tip_along_);
  arrive();
}

}  // namespace orca::sim::detail
