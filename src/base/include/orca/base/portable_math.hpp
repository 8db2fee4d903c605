// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

/// Mathematical functions that compute the same bits on each machine with IEEE 754 doubles.
///
/// The C library's functions round differently in the last bit on processors with fused multiply-add, and from one version
/// to the next. States of a simulated world, readings and decisions of components are computed with
/// these instead. They use +, -, *, / and square roots of doubles only, which the standard defines exactly.
/// std::sqrt, std::fabs, std::floor, std::fmod and std::remainder are exact everywhere and need no replacement.
///
/// Errors are below 1 unit in the last place (ulp) unless a function says otherwise. Infinities, zeros and NaN are treated
/// as in ISO C, annex F. errno and the floating-point flags are not part of the contract.
///
/// @thread  pure functions; any thread. The rounding mode must be the usual one, to nearest.
/// @source  Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18, 1971, for sums and
///          products without loss; Cody and Waite, "Software Manual for the Elementary Functions", 1980, for reduction by
///          parts of a constant. The series are Taylor's. See docs/adr/0047-own-functions.md.
namespace orca::portable {

/// Return sine, cosine and tangent of an angle [rad]. Beyond 1e6 rad they are those of an angle that differs from the given one by
/// less than half its last place. The tangent is wrong by up to 2.5 ulp.
[[nodiscard]] double sin(double angle);
[[nodiscard]] double cos(double angle);
[[nodiscard]] double tan(double angle);

/// The point of the unit circle at an angle.
struct CosSin {
  double cos;
  double sin;
};
/// Returns cos() and sin() of an angle [rad], for little more than the cost of one.
[[nodiscard]] CosSin cos_sin(double angle);

/// Returns the direction of (x, y) in [-pi, pi] rad, counter-clockwise from the x axis.
[[nodiscard]] double atan2(double y, double x);

/// Return the angle in [-pi/2, pi/2] rad whose sine is `x`, and the one in [0, pi] rad whose cosine is `x`. NaN beyond [-1, 1].
/// They are wrong by up to 2 ulp.
[[nodiscard]] double asin(double x);
[[nodiscard]] double acos(double x);

/// Returns e to the power of x. Results below 2.2e-308, the least normal number, are wrong by up to 1 ulp.
[[nodiscard]] double exp(double x);

/// Returns the natural logarithm: -infinity of 0, NaN of negative numbers.
[[nodiscard]] double log(double x);

/// Return the length of a vector, without overflow and underflow on the way. The one of three parts is wrong by up to 2 ulp.
[[nodiscard]] double hypot(double x, double y);
[[nodiscard]] double hypot(double x, double y, double z);

}  // namespace orca::portable
