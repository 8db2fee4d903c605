// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/hw/scene.hpp"

namespace orca::host {

/// A moment of a robot's run that is worth a picture, and why.
struct KeyMoment {
  const Scene::Robot* robot = nullptr;
  const Scene::Moment* moment = nullptr;
  std::string why;  ///< "start", "at kitchen", "contact of Dewey", "end"; empty for a moment between.
};

/// Returns the start, arrivals, contacts and end of each robot's run, ordered by robot, then time. Moments
/// from the middle of the longest gaps fill them up to six, if the run has that many. If a robot has more
/// than twelve, its start and end are kept, and the rest in even steps, twelve in all.
///
/// @return pointers into `scene`.
[[nodiscard]] std::vector<KeyMoment> key_moments(const Scene& scene);

/// Returns the moment of a robot's run that is nearest to a time.
/// @pre  the robot has a moment.
[[nodiscard]] const Scene::Moment& moment_at(const Scene::Robot& robot, TimePoint time);

}  // namespace orca::host
