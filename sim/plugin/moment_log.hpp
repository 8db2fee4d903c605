// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/hw/scene.hpp"
#include "orca/sim/robot_model.hpp"
#include "shared_world.hpp"

namespace orca::sim {

/// The record of what a robot did and sensed in a run, for pictures. It keeps at most 512 moments: in a
/// longer run every second one is discarded, repeatedly. The first and the last moment are always kept.
///
/// Thread contract: not synchronised.
class MomentLog {
 public:
  explicit MomentLog(const RobotModel& robot) : robot_(robot) {}

  void add(const SharedWorld::Inbox& inbox);
  [[nodiscard]] std::vector<Scene::Moment> moments() const;

 private:
  void see(const SharedWorld::Inbox& inbox);
  void keep();

  const RobotModel& robot_;
  Scene::Moment now_;
  std::vector<Scene::Moment> kept_;
  std::size_t step_ = 1;   // One of this many moments is kept.
  std::size_t count_ = 0;  // Number of moments so far.
};

}  // namespace orca::sim
