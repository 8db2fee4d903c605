// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <map>

#include "motion/battery_model.hpp"
#include "orca/base/hash.hpp"
#include "orca/sim/world_model.hpp"
#include "robot.hpp"

namespace orca::sim::detail {

// The batteries of the robots of a running world.
class Batteries {
 public:
  // Both must outlive this.
  Batteries(const WorldModel& world, std::deque<Robot>& robots) : world_(world), robots_(robots) {}

  // Notes that a robot has come, the last one.
  void add();
  // Lets the batteries work for one tick, after the robots have moved. A robot whose battery is empty is driven no more.
  void work(Duration tick);
  // Returns whether a robot slowly brings its front to the contacts of a charger, or beside them: what it touches there is to be touched.
  [[nodiscard]] bool docks(const Robot& robot) const;
  // Returns the battery of the robot of that number; null if it has none.
  [[nodiscard]] const BatteryModel* of(std::size_t robot) const;
  [[nodiscard]] BatteryModel* of(std::size_t robot);
  void add_to(Fnv1a& hash) const;

 private:
  [[nodiscard]] bool is_charged(const Robot& robot) const;

  const WorldModel& world_;
  std::deque<Robot>& robots_;
  std::map<std::size_t, BatteryModel> batteries_;  // by the robots' numbers
};

}  // namespace orca::sim::detail
