// SPDX-License-Identifier: LGPL-3.0-or-later
#include "track.hpp"

#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::colour {
namespace {

constexpr double kAcceleration = 1.5;  // [m/s2] standard deviation of what a person does.
constexpr double kSurprise =
    0.3;  // [m] A sighting may be so far from where the track is, besides three standard deviations.
constexpr double kFirstSpeed = 1.0;  // [m/s] the same of the velocity of who is seen for the first time.

}  // namespace

void Track::see(Vec2 place, double error, double time) {
  advance(time);
  seen_at_ = time;
  time_ = time;
  if (!begun_) {
    begun_ = true;
    place_ = place;
    velocity_ = {};
    variance_ = error * error;
    covariance_ = 0.0;
    velocity_variance_ = kFirstSpeed * kFirstSpeed;
    return;
  }
  const double innovation = variance_ + error * error;
  const double gain = variance_ / innovation;
  const double velocity_gain = covariance_ / innovation;
  const Vec2 off = place - place_;
  place_ = place_ + gain * off;
  velocity_ = velocity_ + velocity_gain * off;
  velocity_variance_ -= velocity_gain * covariance_;
  covariance_ *= 1.0 - gain;
  variance_ *= 1.0 - gain;
}

bool Track::admits(Vec2 place, double error) const {
  if (!begun_ || unseen() > kDoubt) return true;
  return norm(place - place_) <= kSurprise + 3.0 * portable::hypot(place_error(), error);
}

void Track::miss(double time) {
  advance(time);
  time_ = time;
}

void Track::advance(double time) {
  if (begun_ && time - seen_at_ > kUnseen) begun_ = false;
  const double t = time - time_;
  if (!begun_ || t <= 0.0) return;
  const double noise = kAcceleration * kAcceleration;
  place_ = place_ + t * velocity_;
  variance_ += 2.0 * t * covariance_ + t * t * velocity_variance_ + 0.25 * t * t * t * t * noise;
  covariance_ += t * velocity_variance_ + 0.5 * t * t * t * noise;
  velocity_variance_ += t * t * noise;
}

double Track::place_error() const { return std::sqrt(variance_); }
double Track::velocity_error() const { return std::sqrt(velocity_variance_); }

}  // namespace orca::colour
