// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/rplidar/turns.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

namespace orca::hw::rplidar {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kWidestStepBack = kTwoPi / 18.0;  // [rad] of one point behind another
constexpr double kNoEcho = std::numeric_limits<double>::infinity();

// The head corrects the angles of points with echo for the distance of laser and lens. What is not documented is taken from a head of
// this kind: 22 mm, right at 0.155 m, and so up to 8 degrees. Points without echo are not corrected.
constexpr double kBaseline = 0.022;     // [m]
constexpr double kUncorrected = 0.155;  // [m]

double inverse(const std::optional<double>& range) { return 1.0 / range.value_or(kUncorrected); }

// Returns how far the angle goes forward at most [rad] from one point to the next because of their corrections alone.
double corrected_forward(const std::optional<double>& from, const std::optional<double>& to) {
  return kBaseline * std::max(0.0, inverse(to) - inverse(from));
}

}  // namespace

TurnCollector::TurnCollector(std::size_t beams) : beams_(beams) {}

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
// that edge looks like a step forward by nearly a turn: such a point, of the turn before, counts in this one.
const Turn* TurnCollector::add(const Point& point, TimePoint stamp) {
  const auto beams = static_cast<double>(beams_);
  const double place = place_of(point.angle);
  const double step = place - place_;
  const bool follows = has_place_ && stamp - stamp_ <= kLongestPause;
  const double back = kWidestStepBack / kTwoPi * beams;
  if (follows && step > beams - back) {
    if (collects_) mark(place, point);
    return nullptr;
  }
  const double widest = kWidestGap + corrected_forward(range_, point.range);
  place_ = place;
  range_ = point.range;
  stamp_ = stamp;
  has_place_ = true;
  if (!follows) {
    give_up();
    return nullptr;
  }
  const bool begins = step < -back;
  const bool lost = (begins ? step + beams : step) / beams * kTwoPi > widest;
  has_lost_ = has_lost_ || lost;
  const bool is_whole = begins && collects_ && finish(stamp);
  if (begins) begin(stamp, lost);
  if (collects_) mark(place, point);
  return is_whole ? &finished_ : nullptr;
}

void TurnCollector::give_up() {
  if (collects_) ++incomplete_;
  collects_ = false;
}

void TurnCollector::begin(TimePoint stamp, bool lost) {
  collects_ = true;
  has_lost_ = lost;
  turn_.stamp = stamp;
  turn_.ranges.assign(beams_, kNoEcho);
  measured_.assign(beams_, false);
}

void TurnCollector::mark(double place, const Point& point) {
  const std::size_t beam = std::min(static_cast<std::size_t>(place), beams_ - 1);
  measured_[beam] = true;
  turn_.ranges[beam] = std::min(turn_.ranges[beam], point.range.value_or(kNoEcho));
}

bool TurnCollector::finish(TimePoint end) {
  turn_.period = end - turn_.stamp;
  if (turn_.period > kLongestTurn || has_lost_) {
    ++incomplete_;
    return false;
  }
  fill_gaps();
  std::swap(turn_, finished_);
  return true;
}

void TurnCollector::fill_gaps() {
  for (std::size_t begin = 0; begin < beams_;) {
    const auto from = measured_.begin() + static_cast<std::ptrdiff_t>(begin);
    if (*from) {
      ++begin;
      continue;
    }
    const auto end = static_cast<std::size_t>(std::find(from, measured_.end(), true) - measured_.begin());
    const double left = begin > 0 ? turn_.ranges[begin - 1] : kNoEcho;
    const double right = end < beams_ ? turn_.ranges[end] : kNoEcho;
    std::fill(turn_.ranges.begin() + static_cast<std::ptrdiff_t>(begin),
              turn_.ranges.begin() + static_cast<std::ptrdiff_t>(end), std::min(left, right));
    begin = end;
  }
}

}  // namespace orca::hw::rplidar
