// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/goals/trip.hpp"

namespace orca::command {

using go::Trip;

/// A line of a file of goals.
struct GoalLine {
  std::string text;
  std::string place;  ///< For messages: "FILE:LINE:1".
};

/// Reads a file of goals, without its empty lines and comments.
/// @errors  those of read_input_file(); invalid_argument if it has more than 1 MB.
[[nodiscard]] Result<std::vector<GoalLine>> read_goal_file(const std::string& path);

/// The goals of a list, and how far it is driven: once, in several rounds, or in rounds without end.
///
/// Thread contract: not synchronised.
class Agenda {
 public:
  /// Begins another list.
  void set(std::vector<Trip> trips) {
    trips_ = std::move(trips);
    begun_ = 0;
  }
  /// Adds goals behind all others of the round that is driven.
  void add(std::vector<Trip> trips) {
    const std::size_t before = trips_.size();
    if (begun_ > 0) {
      const std::size_t rounds =
          (begun_ - 1) / before;  // whole ones; all goals of the present one may be begun
      begun_ += rounds * trips.size();
    }
    trips_.insert(trips_.end(), std::make_move_iterator(trips.begin()), std::make_move_iterator(trips.end()));
  }
  [[nodiscard]] bool empty() const { return trips_.empty(); }
  /// Returns the names of the goals of this round that were not begun.
  [[nodiscard]] std::vector<std::string> rest(std::size_t rounds) const {
    std::vector<std::string> names;
    if (next(rounds) == nullptr) return names;
    for (std::size_t i = begun_ % trips_.size(); i < trips_.size(); ++i) names.push_back(trips_[i].name);
    return names;
  }

  /// Returns the goal that is to be driven to now; null after the last one.
  /// @param rounds  in which the list is driven; 0: without end.
  [[nodiscard]] const Trip* next(std::size_t rounds) const {
    if (trips_.empty() || (rounds > 0 && begun_ >= rounds * trips_.size())) return nullptr;
    return &trips_[begun_ % trips_.size()];
  }
  /// Takes note that the robot is driven to the next goal.
  void begin() { ++begun_; }

  /// Returns how many goals of this list were begun, in all rounds.
  [[nodiscard]] std::size_t begun() const { return begun_; }
  void go_on_after(std::size_t begun) { begun_ = begun; }

 private:
  std::vector<Trip> trips_;
  std::size_t begun_ = 0;
};

}  // namespace orca::command
