// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robots/characteristics.hpp"

#include <algorithm>

namespace orca::robots {

Pose2 SonarRing::transducer(std::size_t k) const {
  const double angle = angles.empty() ? first_angle + static_cast<double>(k) * pitch : angles[k];
  const Vec2 p = positions.empty() ? radius * direction(angle) : positions[k];
  return center * Pose2{p.x, p.y, angle};
}

const SonarRing* Characteristics::sonar(std::string_view ring) const {
  const auto found = std::ranges::find(sonars, ring, &SonarRing::name);
  return found == sonars.end() ? nullptr : &*found;
}

}  // namespace orca::robots
