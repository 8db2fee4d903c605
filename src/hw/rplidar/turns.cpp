// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/rplidar/turns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace orca::hw::rplidar {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kWidestStepBack = kTwoPi / 18.0;  // [rad] of one point behind another
constexpr double kNoEcho = std::numeric_limits<double>::infinity();

}  // namespace

TurnCollector::TurnCollector(std::size_t beams)
    : beams_(beams),
      widest_(static_cast<std::size_t>(kWidestGap / kTwoPi * static_cast<double>(beams)) + 1) {}

void TurnCollector::restart() {
  collects_ = has_place_ = false;
  incomplete_ = 0;
}

// Returns where an angle is among the beams, from 0 at the near edge of the first one to their number.
double TurnCollector::place_of(double angle) const {
  const auto beams = static_cast<double>(beams_);
  const double place = (std::numbers::pi - angle) / kTwoPi * beams + 0.5;
  return place < beams ? place : place - beams;
}

// A turn begins where the place goes back from the last beams to the first ones. Corrected angles may step back a little, which at
// that edge looks like a step forward by nearly a turn: such a point belongs to the turn before, and is left out.
const Turn* TurnCollector::add(const Point& point, TimePoint stamp) {
  const double place = place_of(point.angle);
  const double step = place - place_;
  const bool follows = has_place_ && stamp - stamp_ <= kLongestPause;
  const double back = kWidestStepBack / kTwoPi * static_cast<double>(beams_);
  if (follows && step > static_cast<double>(beams_) - back) return nullptr;
  place_ = place;
  stamp_ = stamp;
  has_place_ = true;
  if (!follows) {
    give_up();
    return nullptr;
  }
  const bool begins = step < -back;
  const bool is_whole = begins && collects_ && finish(stamp);
  if (begins) begin(stamp);
  if (collects_) mark(std::min(static_cast<std::size_t>(place), beams_ - 1), point);
  return is_whole ? &finished_ : nullptr;
}

void TurnCollector::give_up() {
  if (collects_) ++incomplete_;
  collects_ = false;
}

void TurnCollector::begin(TimePoint stamp) {
  collects_ = true;
  turn_.stamp = stamp;
  turn_.ranges.assign(beams_, kNoEcho);
  measured_.assign(beams_, false);
}

void TurnCollector::mark(std::size_t beam, const Point& point) {
  measured_[beam] = true;
  turn_.ranges[beam] = std::min(turn_.ranges[beam], point.range.value_or(kNoEcho));
}

bool TurnCollector::finish(TimePoint end) {
  turn_.period = end - turn_.stamp;
  if (turn_.period > kLongestTurn || !fill_gaps()) {
    ++incomplete_;
    return false;
  }
  std::swap(turn_, finished_);
  return true;
}

// Returns whether all gaps are narrow.
bool TurnCollector::fill_gaps() {
  for (std::size_t begin = 0; begin < beams_;) {
    const auto from = measured_.begin() + static_cast<std::ptrdiff_t>(begin);
    if (*from) {
      ++begin;
      continue;
    }
    const auto end = static_cast<std::size_t>(std::find(from, measured_.end(), true) - measured_.begin());
    if (end - begin > widest_) return false;
    const double left = begin > 0 ? turn_.ranges[begin - 1] : kNoEcho;
    const double right = end < beams_ ? turn_.ranges[end] : kNoEcho;
    std::fill(turn_.ranges.begin() + static_cast<std::ptrdiff_t>(begin),
              turn_.ranges.begin() + static_cast<std::ptrdiff_t>(end), std::min(left, right));
    begin = end;
  }
  return true;
}

}  // namespace orca::hw::rplidar
