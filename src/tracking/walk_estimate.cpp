// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/tracking/walk_estimate.hpp"

#include <cmath>

namespace orca::tracking {
namespace {

constexpr double kUnrest = 0.1;      // [m2/s3] spectral density of people's acceleration
constexpr double kFirstSpeed = 1.0;  // [m/s] standard deviation of the velocity of a new one

}  // namespace

WalkEstimate WalkEstimate::at(Vec2 place, double error) {
  return {place, {}, error * error, 0.0, kFirstSpeed * kFirstSpeed};
}

void WalkEstimate::predict(double elapsed) {
  place = place + elapsed * velocity;
  variance += elapsed * (2.0 * covariance + elapsed * velocity_variance) +
              kUnrest * elapsed * elapsed * elapsed / 3.0;
  covariance += elapsed * velocity_variance + 0.5 * kUnrest * elapsed * elapsed;
  velocity_variance += kUnrest * elapsed;
}

void WalkEstimate::correct(Vec2 seen, double error) {
  const double gain_below = variance + error * error;
  const double gain = variance / gain_below;
  const double velocity_gain = covariance / gain_below;
  const Vec2 off = seen - place;
  place = place + gain * off;
  velocity = velocity + velocity_gain * off;
  velocity_variance -= velocity_gain * covariance;
  covariance *= 1.0 - gain;
  variance *= 1.0 - gain;
}

double WalkEstimate::place_error() const { return std::sqrt(variance); }
double WalkEstimate::velocity_error() const { return std::sqrt(velocity_variance); }

}  // namespace orca::tracking
