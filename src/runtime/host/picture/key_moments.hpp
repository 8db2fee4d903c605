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
  std::string why;  ///< "start", "at kitchen", "contact of Dewey", "end", or empty: one between.
};

/// Start, arrivals, contacts and end of each robot's run, and moments from the middle of the longest gaps, so
/// that there are at least six if it had so many; ordered by robot, then time. Of more than twelve of a
/// robot, start, end and twelve less two in even steps are kept.
///
/// @return pointers into `scene`.
[[nodiscard]] std::vector<KeyMoment> key_moments(const Scene& scene);

}  // namespace orca::host
