// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <numbers>

#include "cells.hpp"
#include "cone.hpp"
#include "orca/geometry/vec2.hpp"

namespace orca::sim::detail {

// The cells that rays of a cone may cross, strip by strip, nearest first. The strips are columns or rows,
// whichever lie more across the cone.
class Strips {
 public:
  static constexpr double kWide = 0.2 * std::numbers::pi;  // [rad] The widest half angle.

  // @pre  the cells outlive it.
  Strips(const Cells& cells, const Cone& cone);

  // Returns the distance [m] before which no ray enters this strip or a later one; infinite if none is left.
  [[nodiscard]] double begin() const { return begin_; }

  // Calls visit(cell) for the cells of this strip, then advances to the next. @pre  a strip is left.
  template <class Visit>
  void next(const Visit& visit) {
    const double from = std::max(0.0, entry_);
    const double to = std::max(0.0, entry_ + cells_->size());
    const int first = across(tip_across_ + low_ * (low_ < 0.0 ? to : from) - aside_);
    const int last = across(tip_across_ + high_ * (high_ < 0.0 ? from : to) + aside_);
    for (int i = first; i <= last; ++i)
      visit(by_columns_ ? cells_->cell(strip_, i) : cells_->cell(i, strip_));
    advance();
  }

 private:
  [[nodiscard]] double along(Vec2 v) const { return by_columns_ ? v.x : v.y; }
  [[nodiscard]] double aside(Vec2 v) const { return by_columns_ ? v.y : v.x; }
  [[nodiscard]] int across(double place) const {
    return by_columns_ ? cells_->row(place) : cells_->column(place);
  }
  void advance() {
    strip_ += step_;
    entry_ += cells_->size();
    arrive();
  }
  void arrive() {
    const bool is_there = strip_ >= 0 && strip_ < strips_;
    begin_ =
        is_there ? std::max(0.0, (entry_ - slack_) * slowness_) : std::numeric_limits<double>::infinity();
  }

  const Cells* cells_ = nullptr;
  bool by_columns_ = true;
  int strips_ = 0;
  int step_ = 1;             // Difference from this strip's number to the next one's.
  int strip_ = 0;            // Number of the present strip.
  double tip_along_ = 0.0;   // [m]
  double tip_across_ = 0.0;  // [m]
  double low_ = 0.0;         // Slopes of the two rims relative to the direction across the strips.
  double high_ = 0.0;
  double aside_ = 0.0;     // [m] Largest distance of a ray's origin from the rims, along the strips.
  double slack_ = 0.0;     // [m] Largest distance of a ray's origin from the tip.
  double slowness_ = 1.0;  // Smallest length of a ray per metre across the strips.
  double entry_ = 0.0;     // [m] Distance from the tip to the present strip, across the strips.
  double begin_ = std::numeric_limits<double>::infinity();
};

}  // namespace orca::sim::detail
