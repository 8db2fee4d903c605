// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wheel_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "orca/base/portable_math.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kSin60 = 0.8660254037844386;
// Rolling directions of three wheels at 60, 180 and 300 degrees when the base turns to the left.
constexpr std::array<Vec2, 3> kTangents{Vec2{-kSin60, 0.5}, Vec2{0.0, -1.0}, Vec2{kSin60, 0.5}};

}  // namespace

WheelErrors WheelErrors::drawn(DriveKind kind, const ErrorLevels& errors, RandomStream& random) {
  WheelErrors drawn{.slip = errors.slip,
                    .turn_slip = errors.turn_slip,
                    .slip_length = errors.slip_length,
                    .common_slip = errors.common_slip,
                    .common_length = errors.common_length,
                    .slip_angle = errors.slip_angle};
  drawn.track = random.uniform(-errors.track_error, errors.track_error);
  const double half = 0.5 * errors.wheel_mismatch;
  if (kind == DriveKind::differential) {
    const double apart = random.uniform(-errors.wheel_mismatch, errors.wheel_mismatch);
    const double mean = random.uniform(-errors.wheel_size, errors.wheel_size);
    drawn.diameter = {mean - 0.5 * apart, mean + 0.5 * apart, 0.0};
  } else {
    for (double& diameter : drawn.diameter) diameter = random.uniform(-half, half);
    const double left = std::max(0.0, errors.wheel_size - half);
    const double mean = left > 0.0 ? random.uniform(-left, left) : 0.0;
    for (double& diameter : drawn.diameter) diameter += mean;
  }
  return drawn;
}

WheelModel::WheelModel(const Drive& drive, const WheelErrors& errors)
    : kind_(drive.kind),
      errors_(errors),
      track_(drive.track),
      rolling_(wheels(), {errors.slip, errors.slip_length}),
      turning_(wheels(), {errors.turn_slip, errors.slip_angle}),
      common_(errors.common_slip, errors.common_length) {}

// Returns how far each wheel goes over the floor when the base moves like that. A wheel that cannot roll
// sideways is dragged then, and does not turn.
WheelModel::Ways WheelModel::ways_of(const Travel2& base, double track) const {
  const double round = 0.5 * track * base.turn;
  if (kind_ == DriveKind::differential) return {base.forward - round, base.forward + round, 0.0};
  if (kind_ == DriveKind::synchro) return {base.forward, base.forward, base.forward};
  Ways ways{};
  for (std::size_t k = 0; k < 3; ++k) ways[k] = dot(kTangents[k], {base.forward, base.left}) + round;
  return ways;
}

// Returns how the base moves when its wheels go that far.
Travel2 WheelModel::base_of(const Ways& ways, double track) const {
  if (kind_ == DriveKind::differential) return {0.5 * (ways[0] + ways[1]), 0.0, (ways[1] - ways[0]) / track};
  if (kind_ == DriveKind::synchro) return {std::accumulate(ways.begin(), ways.end(), 0.0) / 3.0, 0.0, 0.0};
  Travel2 sum;
  for (std::size_t k = 0; k < 3; ++k) {
    sum.forward += 2.0 / 3.0 * ways[k] * kTangents[k].x;
    sum.left += 2.0 / 3.0 * ways[k] * kTangents[k].y;
    sum.turn += ways[k] / (1.5 * track);
  }
  return sum;
}

void WheelModel::draw_slip(const Travel2& base, const Ways& rolled, const Footing& footing,
                           RandomStream& random) {
  const double way = portable::hypot(base.forward, base.left);
  const double share = way > 0.0 ? common_.over(way, random) / way : 0.0;
  const Ways common = ways_of({share * base.forward, share * base.left, 0.0}, track_);
  for (std::size_t k = 0; k < wheels(); ++k) {
    const double own = rolling_[k].over(rolled[k], random) + turning_[k].over(base.turn, random);
    slip_[k] = footing.slip * (common[k] + own) - std::copysign(footing.lost[k], rolled[k]);
  }
}

std::vector<Vec2> WheelModel::places() const {
  if (kind_ == DriveKind::differential) return {{0.0, 0.5 * track_}, {0.0, -0.5 * track_}};
  std::vector<Vec2> places;
  for (const Vec2& tangent : kTangents) places.push_back(0.5 * track_ * Vec2{tangent.y, -tangent.x});
  return places;
}

Travel2 WheelModel::over_ground(const Travel2& rolled, double steering, const Footing& footing,
                                RandomStream& random) {
  Ways ways = ways_of(rolled, track_);
  draw_slip(rolled, ways, footing, random);
  for (std::size_t k = 0; k < wheels(); ++k) ways[k] = ways[k] * (1.0 + errors_.diameter[k]) + slip_[k];
  Travel2 real = base_of(ways, true_track());
  if (kind_ != DriveKind::synchro) return real;
  // One motor steers all wheels, so their angle on the body is exact. But wheels that go unequally far turn the
  // body (least squares over the three), and nothing measures that.
  real.turn = rolled.turn;
  const Vec2 ahead = direction(steering);
  for (std::size_t k = 0; k < 3; ++k) real.turn += ways[k] * dot(kTangents[k], ahead) / (0.75 * true_track());
  return real;
}

Travel2 WheelModel::rolled(const Travel2& real) const {
  Ways ways = ways_of(real, true_track());
  if (kind_ == DriveKind::synchro) {  // All wheels turn alike, whatever each of them does on the floor.
    double scale = 0.0;
    for (std::size_t k = 0; k < 3; ++k) scale += (1.0 + errors_.diameter[k]) / 3.0;
    return {(real.forward - base_of(slip_, track_).forward) / scale, 0.0, 0.0};
  }
  for (std::size_t k = 0; k < wheels(); ++k) ways[k] = (ways[k] - slip_[k]) / (1.0 + errors_.diameter[k]);
  return base_of(ways, track_);
}

}  // namespace orca::sim::detail
