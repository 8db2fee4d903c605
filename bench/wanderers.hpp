// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "comparison.hpp"
#include "orca/base/team.hpp"
#include "orca/sim/world.hpp"
#include "sim_scenes.hpp"

namespace orca::bench {

struct Setting {
  std::size_t robots = 1;
  sim::Realism realism = sim::Realism::nominal;
  unsigned threads = 1;  ///< Threads that compute sensor readings.
};

/// Robots that wander about a world. They drive ahead while there is room, and otherwise turn on the spot.
/// Without sensors they stand still.
class Wanderers {
 public:
  /// @param area  where they start.
  Wanderers(const sim::WorldModel& model, const Setting& setting, bool sensing, const sim::Bounds& area);
  Wanderers(const sim::WorldModel& model, const Setting& setting, bool sensing)
      : Wanderers(model, setting, sensing, model.bounds()) {}

  void run_a_second();

 private:
  [[nodiscard]] bool is_free(sim::RobotId id) const;
  void steer(sim::RobotId id, bool free);

  sim::World world_;
  Team team_;
  bool sensing_;
  Fan fan_;
  std::vector<sim::RobotId> robots_;
  std::vector<char> free_;  // Per robot: whether there is room ahead.
};

/// Returns the time of a simulated second.
Nanoseconds seconds_of(Wanderers& wanderers, int seconds);

}  // namespace orca::bench
