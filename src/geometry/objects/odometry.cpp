// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/geometry/objects/odometry.hpp"

#include <cmath>

#include "matrix.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/geometry/arc.hpp"

namespace orca {
namespace {

// Below this [rad] the series is exact to the last digits, but the quotient is not.
constexpr double kSmall = 0.05;

constexpr double kSin60 = 0.8660254037844386;
// Rolling directions of three wheels at 60, 180 and 300 degrees when the base turns to the left.
constexpr std::array<Vec2, 3> kTangents{Vec2{-kSin60, 0.5}, Vec2{0.0, -1.0}, Vec2{kSin60, 0.5}};

// Returns the derivative of sin(h) / h, the chord per arc that turns by 2 h.
double chord_ratio_slope(double h) {
  const double q = h * h;
  if (std::abs(h) < kSmall) return -h / 3.0 * (1.0 - q / 10.0 * (1.0 - q / 28.0 * (1.0 - q / 54.0)));
  return (portable::cos(h) - portable::sin(h) / h) / h;
}

Eigen::Vector3d vector_of(const Travel2& travel) { return {travel.forward, travel.left, travel.turn}; }

// Returns the derivatives of the pose at the end of an arc by the pose at its start.
Eigen::Matrix3d slope_by_start(const Vec2& chord) {
  Eigen::Matrix3d slope;
  slope << 1, 0, -chord.y, 0, 1, chord.x, 0, 0, 1;
  return slope;
}

// Returns its derivatives by the travel forward, to the left and round.
// @param yaw [rad]  at the start.
Eigen::Matrix3d slope_by_travel(double yaw, const Travel2& travel, const Vec2& chord) {
  const double h = 0.5 * travel.turn;
  const Vec2 ahead = direction(yaw + h);
  const Vec2 way = rotated({travel.forward, travel.left}, yaw + h);
  const double ratio = chord_ratio(travel.turn);
  const double lengthening = 0.5 * chord_ratio_slope(h);  // of the chord, relative to the arc, by the turn
  Eigen::Matrix3d slope;
  slope << ratio * ahead.x, -ratio * ahead.y, lengthening * way.x - 0.5 * chord.y,  //
      ratio * ahead.y, ratio * ahead.x, lengthening * way.y + 0.5 * chord.x,        //
      0.0, 0.0, 1.0;
  return slope;
}

template <int Columns>
auto rows(std::array<double, static_cast<std::size_t>(3 * Columns)>& entries) {
  return Eigen::Map<Eigen::Matrix<double, 3, Columns, Eigen::RowMajor>>(entries.data());
}

}  // namespace

OdometryUncertainty::OdometryUncertainty(idl::DriveType type, double track, const WheelErrorGuess& guess)
    : wheels_(wheels_of(type, track)), guess_(guess), track_counts_(type != idl::SYNCHRO) {}

std::vector<OdometryUncertainty::Wheel> OdometryUncertainty::wheels_of(idl::DriveType type, double track) {
  if (type == idl::DIFFERENTIAL) {
    return {{{1.0, 0.0}, -0.5 * track, {0.5, 0.0, -1.0 / track}, {}},
            {{1.0, 0.0}, 0.5 * track, {0.5, 0.0, 1.0 / track}, {}}};
  }
  std::vector<Wheel> wheels;
  for (const Vec2& tangent : kTangents) {
    if (type == idl::SYNCHRO) {
      // The wheels roll abreast. A wheel that goes farther turns the body, by least squares over the three.
      wheels.push_back({{1.0, 0.0}, 0.0, {1.0 / 3.0, 0.0, 0.0}, (1.0 / (0.75 * track)) * tangent});
    } else {
      wheels.push_back(
          {tangent, 0.5 * track, {2.0 / 3.0 * tangent.x, 2.0 / 3.0 * tangent.y, 1.0 / (1.5 * track)}, {}});
    }
  }
  return wheels;
}

void OdometryUncertainty::move_to(const Pose2& X_OR) {
  const Travel2 travel = arc_between(X_OR_, X_OR);
  const Vec2 way = X_OR.position() - X_OR_.position();
  const Eigen::Matrix3d by_start = slope_by_start(way);
  const Eigen::Matrix3d by_travel = slope_by_travel(X_OR_.yaw, travel, way);

  Eigen::Matrix3d slip = Eigen::Matrix3d::Zero();  // covariance of this step's travel
  Eigen::Matrix<double, 3, kErrors> by_error = Eigen::Matrix<double, 3, kErrors>::Zero();
  for (std::size_t k = 0; k < wheels_.size(); ++k) {
    const double rolled = wheels_[k].travel(travel);
    const Eigen::Vector3d moved = vector_of(wheels_[k].effect(X_OR_.yaw + 0.5 * travel.turn));
    slip += slip_variance(rolled, travel.turn) * moved * moved.transpose();
    by_error.col(static_cast<Eigen::Index>(k)) = rolled * moved;
  }
  if (track_counts_) by_error(2, kErrors - 1) = -travel.turn;

  const Eigen::Matrix3d before = geometry::matrix_of<3>(slip_);
  geometry::store<3>(by_start * before * by_start.transpose() + by_travel * slip * by_travel.transpose(),
                     slip_);
  auto effect = rows<kErrors>(effect_);
  effect = (by_start * effect + by_travel * by_error).eval();
  X_OR_ = X_OR;
}

// Returns the variance of a wheel's travel [m2] in a step.
double OdometryUncertainty::slip_variance(double rolled, double turn) const {
  return guess_.slip * guess_.slip * std::abs(rolled) + guess_.turn_slip * guess_.turn_slip * std::abs(turn);
}

std::array<double, 9> OdometryUncertainty::covariance() const {
  const double wheel = guess_.diameter * guess_.diameter;
  const Eigen::Vector4d variance(wheel, wheel, wheel, guess_.track * guess_.track);
  Effect copy = effect_;
  const auto effect = rows<kErrors>(copy);
  std::array<double, 9> entries{};
  geometry::store<3>(geometry::matrix_of<3>(slip_) + effect * variance.asDiagonal() * effect.transpose(),
                     entries);
  return entries;
}

}  // namespace orca
