// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "goal_list.hpp"

namespace orca::command {

/// The goals of a list, and how far it is driven: once, in several rounds, or in rounds without end.
///
/// Thread contract: not synchronised.
class Agenda {
 public:
  /// Begins another list.
  void set(std::vector<Route> routes) {
    routes_ = std::move(routes);
    begun_ = 0;
  }
  [[nodiscard]] bool empty() const { return routes_.empty(); }

  /// Returns the goal that is to be driven to now; null after the last one.
  /// @param rounds  in which the list is driven; 0: without end.
  [[nodiscard]] const Route* next(std::size_t rounds) const {
    if (routes_.empty() || (rounds > 0 && begun_ >= rounds * routes_.size())) return nullptr;
    return &routes_[begun_ % routes_.size()];
  }
  /// Takes note that the robot is driven to the next goal.
  void begin() { ++begun_; }

  /// How many goals of this list were begun, in all rounds.
  [[nodiscard]] std::size_t begun() const { return begun_; }
  void go_on_after(std::size_t begun) { begun_ = begun; }

 private:
  std::vector<Route> routes_;
  std::size_t begun_ = 0;
};

}  // namespace orca::command
