// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <numbers>

#include "motion/wheel_model.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::sim::test {

/// A square whose encoders report it exactly: four legs, and a turn behind each.
struct Square {
  double leg = 4.0;                      ///< [m]
  double turn = 0.5 * std::numbers::pi;  ///< [rad] positive: counter-clockwise
  double track = 0.0;                    ///< [m] that the controller assumes
};

/// Returns where a differential base ends a square that begins in the origin, in closed form: each leg and each turn is an
/// arc, since both wheels roll evenly. Slip is left out.
inline Pose2 end_of_square(const Square& square, const detail::WheelErrors& errors) {
  using Complex = std::complex<double>;
  const auto [left, right, none] = errors.diameter;
  const double true_track = square.track * (1.0 + errors.track);
  Complex end = 0.0;
  double yaw = 0.0;
  const auto roll = [&, left = left, right = right](double left_way, double right_way) {
    const double l = left_way * (1.0 + left);
    const double r = right_way * (1.0 + right);
    const double turn = (r - l) / true_track;
    const Complex chord =
        turn == 0.0 ? Complex(1.0) : (std::exp(Complex(0.0, turn)) - 1.0) / Complex(0.0, turn);
    end += std::exp(Complex(0.0, yaw)) * 0.5 * (l + r) * chord;
    yaw += turn;
  };
  const double round = 0.5 * square.turn * square.track;
  for (int corner = 0; corner < 4; ++corner) {
    roll(square.leg, square.leg);
    roll(-round, round);
  }
  return {end.real(), end.imag(), wrapped(yaw)};
}

}  // namespace orca::sim::test
