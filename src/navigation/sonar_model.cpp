// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/sonar_model.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::nav {
namespace {

constexpr double kSonarError = 0.1;   // [m]
constexpr double kShareOfEcho = 0.5;  // of its evidence, as neighbours hear the same

// Returns how far a sonar would hear something of the map at the nearest.
double nearest_echo(const KnownMap& map, const SonarEcho& echo, const Pose2& X_MR) {
  const Pose2 X_MS = X_MR * echo.X_RS;
  double nearest = echo.max_range;
  for (const double share : {-0.7, 0.0, 0.7}) {
    const Sight sight =
        map.look(X_MS.position(), direction(X_MS.yaw + share * echo.half_lobe), echo.max_range);
    if (sight.end == Sight::End::wall) nearest = std::min(nearest, sight.range);
  }
  return nearest;
}

bool says_something(const SonarEcho& echo) {
  return !std::isnan(echo.range) && std::isfinite(echo.max_range) &&
         std::isfinite(echo.X_RS.x + echo.X_RS.y + echo.X_RS.yaw + echo.half_lobe);
}

double likelihood_of(const SonarEcho& echo, double expected) {
  if (echo.range >= echo.max_range) return expected >= echo.max_range ? 0.9 : 0.4;
  const double off = (echo.range - expected) / kSonarError;
  return 0.8 * portable::exp(-0.5 * off * off) + (off < 0.0 ? 0.1 : 0.2);
}

}  // namespace

double likelihood(std::span<const SonarEcho> echoes, const KnownMap& map, const Pose2& X_MR) {
  double sum = 0.0;
  for (const SonarEcho& echo : echoes)
    if (says_something(echo)) sum += portable::log(likelihood_of(echo, nearest_echo(map, echo, X_MR)));
  return std::max(1e-100, portable::exp(kShareOfEcho * sum));
}

double share_heard(std::span<const SonarEcho> echoes, const KnownMap& map, const Pose2& X_MR) {
  Explanation explained;
  for (const SonarEcho& echo : echoes) {
    if (echo.range >= echo.max_range || !says_something(echo)) continue;
    const double off = echo.range - nearest_echo(map, echo, X_MR);
    if (std::fabs(off) <= 2.0 * kSonarError) {
      explained.hits += 1.0;
    } else {
      // Behind the wall counts half, too: a slanting wall throws the sound on to the next one.
      (off < 0.0 ? explained.shorts : explained.longs) += off < 0.0 ? 1.0 : 0.5;
    }
  }
  return explained.share();
}

}  // namespace orca::nav
