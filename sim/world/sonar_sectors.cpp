// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sonar_sectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "single_precision.hpp"

namespace orca::sim::detail {
namespace {

// What single precision may lose of times, which are small.
constexpr float kTimeMargin = 1e-5F;  // [s]
float margin_at(Vec2 place) { return single(single_margin(place)); }

// So many marks are looked at together.
constexpr std::size_t kGroup = 8;

}  // namespace

void Sectors::clear(double base) {
  base_ = base;
  for (auto& column : columns_) column.clear();
}

void Sectors::add(const Sector& s) {
  const Circle& around = s.around;
  const std::array<double, kColumns> values{s.tip.x,       s.tip.y,        s.left.x,        s.left.y,
                                            s.right.x,     s.right.y,      around.center.x, around.center.y,
                                            around.radius, s.sent - base_, s.silent - base_};
  for (std::size_t c = 0; c < kColumns; ++c) columns_[c].push_back(single(values[c]));
  columns_[radius].back() += margin_at(around.center);
}

void Sectors::mark(const Sector& one, double silent_from, double sent_until) const {
  const auto column = [this](Column c) { return columns_[c].data(); };
  const float* const TX = column(tip_x);
  const float* const TY = column(tip_y);
  const float* const LX = column(left_x);
  const float* const LY = column(left_y);
  const float* const RX = column(right_x);
  const float* const RY = column(right_y);
  const float* const X = column(x);
  const float* const Y = column(y);
  const float* const R = column(radius);
  const float* const S = column(sent);
  const float* const E = column(silent);
  std::int32_t* const marks = marks_.data();

  const float tx = single(one.tip.x);
  const float ty = single(one.tip.y);
  const float lx = single(one.left.x);
  const float ly = single(one.left.y);
  const float rx = single(one.right.x);
  const float ry = single(one.right.y);
  const float cx = single(one.around.center.x);
  const float cy = single(one.around.center.y);
  const float r = single(one.around.radius) + margin_at(one.around.center);
  const float from = single(silent_from - base_) - kTimeMargin;
  const float until = single(sent_until - base_) + kTimeMargin;
  const std::size_t count = columns_[tip_x].size();
  for (std::size_t i = 0; i < count; ++i) {
    const float to_x = X[i] - tx;
    const float to_y = Y[i] - ty;
    const float back_x = cx - TX[i];
    const float back_y = cy - TY[i];
    // Neither's circle lies beside the other. Without branches: nobody can foresee how they go.
    marks[i] = (lx * to_y - ly * to_x <= R[i]) & (rx * to_y - ry * to_x >= -R[i]) &
               (LX[i] * back_y - LY[i] * back_x <= r) & (RX[i] * back_y - RY[i] * back_x >= -r) &
               (E[i] >= from) & (S[i] <= until);
  }
}

std::span<const std::uint32_t> Sectors::near(const Sector& one, double silent_from, double sent_until) const {
  const std::size_t count = columns_[tip_x].size();
  const std::size_t places = (count + kGroup - 1) / kGroup * kGroup;
  if (marks_.size() < places) marks_.resize(places);
  if (found_.size() < places) found_.resize(places);
  std::fill_n(marks_.begin() + static_cast<std::ptrdiff_t>(count), places - count, 0);
  mark(one, silent_from, sent_until);
  std::size_t found = 0;
  for (std::size_t group = 0; group < count; group += kGroup) {
    std::array<std::uint64_t, kGroup / 2> pairs{};
    std::memcpy(pairs.data(), &marks_[group], sizeof pairs);
    if ((pairs[0] | pairs[1] | pairs[2] | pairs[3]) == 0) continue;
    for (std::size_t i = group; i < group + kGroup; ++i) {
      found_[found] = static_cast<std::uint32_t>(i);
      found += static_cast<std::size_t>(marks_[i]);
    }
  }
  return {found_.data(), found};
}

}  // namespace orca::sim::detail
