// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sonar_sectors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rays/marks.hpp"

namespace orca::sim::detail {
namespace {

// Bound on the rounding error of times in single precision; times relative to the base are small.
constexpr float kTimeMargin = 1e-5F;  // [s]
constexpr double kRounding = 1e-6;    // [bins]
constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

void Sectors::clear(double base) {
  base_ = base;
  widest_ = 0.0;
  for (Bin& bin : bins_) {
    for (auto& column : bin.columns) column.clear();
    bin.numbers.clear();
  }
}

void Sectors::add(const Sector& s, std::uint64_t number) {
  const std::array<double, kColumns> values{
      s.tip.x,        s.tip.y,         s.left.x, s.left.y, s.right.x, s.right.y, single_margin(s.tip),
      s.sent - base_, s.silent - base_};
  const double bins = s.yaw / kTurn * kBins + kBins;
  Bin& bin = bins_[static_cast<std::size_t>(bins) % kBins];
  for (std::size_t c = 0; c < kColumns; ++c) bin.columns[c].push_back(single(values[c]));
  bin.numbers.push_back(number);
  widest_ = std::fmax(widest_, s.half_angle);
}

void Sectors::mark(const Bin& bin, const Question& asked, std::int32_t* marks) {
  const auto column = [&bin](Column c) { return bin.columns[c].data(); };
  const float* const TX = column(tip_x);
  const float* const TY = column(tip_y);
  const float* const LX = column(left_x);
  const float* const LY = column(left_y);
  const float* const RX = column(right_x);
  const float* const RY = column(right_y);
  const float* const M = column(margin);
  const float* const S = column(sent);
  const float* const E = column(silent);
  const Question one = asked;
  const std::size_t count = bin.numbers.size();
  for (std::size_t i = 0; i < count; ++i) {
    const float x = TX[i] - one.x;
    const float y = TY[i] - one.y;
    const float m = M[i] + one.margin;
    // Neither tip lies outside the other's sector. There are no branches, because they cannot be predicted.
    marks[i] = (one.left_x * y - one.left_y * x <= m) & (one.right_x * y - one.right_y * x >= -m) &
               (LX[i] * y - LY[i] * x >= -m) & (RX[i] * y - RY[i] * x <= m) & (E[i] >= one.silent_from) &
               (S[i] <= one.sent_until);
  }
}

std::span<const std::uint64_t> Sectors::facing(const Sector& one, double silent_from, double sent_until,
                                               Search& search) const {
  const Question asked{single(one.tip.x),
                       single(one.tip.y),
                       single(one.left.x),
                       single(one.left.y),
                       single(one.right.x),
                       single(one.right.y),
                       single(single_margin(one.tip)),
                       single(silent_from - base_) - kTimeMargin,
                       single(sent_until - base_) + kTimeMargin};
  search.found.clear();
  // A sector that faces `one` has the opposite direction, to within the sum of both half angles.
  const double bin = wrapped(one.yaw + 0.5 * kTurn) / kTurn * kBins + kBins;
  const double aside = (one.half_angle + widest_) / kTurn * kBins + kRounding;
  const int first = static_cast<int>(std::floor(bin - aside));
  const int last = std::min(static_cast<int>(std::floor(bin + aside)), first + kBins - 1);
  for (int b = first; b <= last; ++b) {
    const Bin& some = bins_[static_cast<std::size_t>((b + kBins) % kBins)];
    const std::size_t count = some.numbers.size();
    if (search.marks.size() < count + kMarkGroup) search.marks.resize(count + kMarkGroup);
    mark(some, asked, search.marks.data());
    for_all_marked(search.marks.data(), count,
                   [&](std::size_t i) { search.found.push_back(some.numbers[i]); });
  }
  return search.found;
}

}  // namespace orca::sim::detail
