// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "orca/navigation/map_localizer.hpp"

namespace orca::nav {
namespace {

double square(double x) { return x * x; }

}  // namespace

std::array<double, 3> deviations_of(const Reckoned& before, const Reckoned& now) {
  const Pose2 step = seen_from(before.X_OR, now.X_OR);
  const double way = norm(step.position());
  const double turn = std::fabs(step.yaw);
  // The part that comes of the errors so far is taken off; the rest is its own.
  const Vec2 chord = now.X_OR.position() - before.X_OR.position();
  const auto& a = before.covariance;
  const auto& b = now.covariance;
  const double xx = b[0] - (a[0] - 2.0 * chord.y * a[2] + square(chord.y) * a[8]);
  const double yy = b[4] - (a[4] + 2.0 * chord.x * a[5] + square(chord.x) * a[8]);
  const double place = std::sqrt(std::max(0.0, 0.5 * (xx + yy)));
  const double turned = std::sqrt(std::max(0.0, b[8] - a[8]));
  const double least = 0.002 + 0.02 * way + 0.01 * turn;
  const double least_turn = 0.003 + 0.05 * turn + 0.03 * way;
  const double most = least + 0.2 * way;
  const double most_turn = least_turn + 0.2 * turn + 0.1 * way;
  const double of_place = std::clamp(place, least, most);
  return {of_place, of_place, std::clamp(turned, least_turn, most_turn)};
}

}  // namespace orca::nav
