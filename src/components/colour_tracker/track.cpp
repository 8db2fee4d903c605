// SPDX-License-Identifier: LGPL-3.0-or-later
#include "track.hpp"

#include "orca/base/portable_math.hpp"

namespace orca::colour {
namespace {

constexpr double kSurprise =
    0.3;  // [m] A sighting may be so far from where the track is, besides three standard deviations.

}  // namespace

void Track::see(Vec2 place, double error, double time) {
  advance(time);
  seen_at_ = time;
  time_ = time;
  if (begun_)
    walk_.correct(place, error);
  else
    walk_ = tracking::WalkEstimate::at(place, error);
  begun_ = true;
}

bool Track::admits(Vec2 place, double error) const {
  if (!begun_ || unseen() > kDoubt) return true;
  return norm(place - walk_.place) <= kSurprise + 3.0 * portable::hypot(place_error(), error);
}

void Track::miss(double time) {
  advance(time);
  time_ = time;
}

void Track::advance(double time) {
  if (begun_ && time - seen_at_ > kUnseen) begun_ = false;
  const double t = time - time_;
  if (begun_ && t > 0.0) walk_.predict(t);
}

}  // namespace orca::colour
