// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/hw/scene.hpp"
#include "orca/sim/robot_model.hpp"
#include "shared_world.hpp"

namespace orca::sim {

/// What a robot did and sensed in the course of a run, for pictures. At most 512 moments: of a longer run
/// every second is forgotten, again and again; the first and the last are always there.
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
  std::size_t step_ = 1;   // of so many moments one is kept
  std::size_t count_ = 0;  // of moments so far
};

}  // namespace orca::sim
