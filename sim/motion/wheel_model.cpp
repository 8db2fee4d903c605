// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wheel_model.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kSin60 = 0.8660254037844386;
// Rolling directions of three wheels at 60, 180 and 300 degrees when the base turns to the left.
constexpr std::array<Vec2, 3> kTangents{Vec2{-kSin60, 0.5}, Vec2{0.0, -1.0}, Vec2{kSin60, 0.5}};

}  // namespace

WheelErrors WheelErrors::drawn(DriveKind kind, const ErrorLevels& errors, RandomStream& random) {
  WheelErrors drawn;
  drawn.track = random.uniform(-errors.track_error, errors.track_error);
  const std::size_t wheels = kind == DriveKind::differential ? 2 : 3;
  for (std::size_t k = 0; k < wheels; ++k)
    drawn.diameter[k] = random.uniform(-errors.wheel_mismatch, errors.wheel_mismatch);
  drawn.slip = errors.slip;
  return drawn;
}

Travel2 WheelModel::measured(const Travel2& real, RandomStream& random) const {
  switch (kind_) {
    case DriveKind::differential: return differential(real, random);
    case DriveKind::synchro: return synchro(real, random);
    case DriveKind::holonomic: return holonomic(real, random);
  }
  return real;
}

double WheelModel::wheel(std::size_t number, double travel, RandomStream& random) const {
  return travel * (1.0 + errors_.diameter[number]) +
         random.normal(0.0, errors_.slip * std::sqrt(std::fabs(travel)));
}

Travel2 WheelModel::differential(const Travel2& real, RandomStream& random) const {
  const double left = wheel(0, real.forward - 0.5 * real.turn * track_, random);
  const double right = wheel(1, real.forward + 0.5 * real.turn * track_, random);
  return {0.5 * (left + right), 0.0, (right - left) / (track_ * (1.0 + errors_.track))};
}

// One motor drives all wheels and one steers them, so the steering angle on the body is exact. But wheels
// that slip unequally turn the body (least squares over the three), and nothing measures that.
Travel2 WheelModel::synchro(const Travel2& real, RandomStream& random) const {
  double mean = 0.0;
  double twist = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double travel = wheel(k, real.forward, random);
    const double slip = travel - real.forward * (1.0 + errors_.diameter[k]);
    mean += travel / 3.0;
    twist += slip * kTangents[k].x / (0.75 * track_);
  }
  return {mean, 0.0, real.turn + twist};
}

Travel2 WheelModel::holonomic(const Travel2& real, RandomStream& random) const {
  Travel2 sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 rolls = kTangents[k];
    const double travel = wheel(k, dot(rolls, {real.forward, real.left}) + 0.5 * track_ * real.turn, random);
    sum.forward += 2.0 / 3.0 * travel * rolls.x;
    sum.left += 2.0 / 3.0 * travel * rolls.y;
    sum.turn += travel / (1.5 * track_ * (1.0 + errors_.track));
  }
  return sum;
}

}  // namespace orca::sim::detail
