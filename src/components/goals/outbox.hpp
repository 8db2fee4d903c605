// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace orca::go {

/// The objects that must still be sent for one goal: points of its route to Goto, and the list of behaviours to the fuser. A
/// receiver that was started again has forgotten them, so it gets them once more, without the points that the
/// robot has passed.
///
/// Thread contract: not synchronised.
class Outbox {
 public:
  /// As SendProxy::server_restarts().
  using Restarts = std::optional<std::uint64_t>;

  /// @param points  of the route: the via points and the goal.
  explicit Outbox(std::size_t points) : points_(points) {}

  /// Begins with other points for the same goal; the list of behaviours stays.
  void lay_out(std::size_t points) {
    points_ = points;
    ahead_ = next_ = 0;
  }
  /// Takes note of how often the receivers have been started again by now.
  void note_restarts(Restarts of_goto, Restarts of_fuser) {
    if (of_goto != of_goto_) next_ = ahead_;
    if (of_fuser != of_fuser_) list_is_due_ = true;
    of_goto_ = of_goto;
    of_fuser_ = of_fuser;
  }
  /// Returns whether a receiver was started again since the last note_restarts().
  [[nodiscard]] bool is_outdated(Restarts of_goto, Restarts of_fuser) const {
    return of_goto != of_goto_ || of_fuser != of_fuser_;
  }

  /// Takes note of how many points are still before the robot. The goal always is.
  void note_left(std::size_t points) { ahead_ = points_ - std::clamp<std::size_t>(points, 1, points_); }
  [[nodiscard]] std::size_t points_left() const { return points_ - ahead_; }

  /// Returns the index of the point to be sent next; nothing if Goto has all of them.
  [[nodiscard]] std::optional<std::size_t> next_point() const {
    return next_ == points_ ? std::nullopt : std::optional(next_);
  }
  void point_sent() { ++next_; }
  [[nodiscard]] bool list_is_due() const { return list_is_due_; }
  void list_sent() { list_is_due_ = false; }
  void list_changed() { list_is_due_ = true; }
  [[nodiscard]] bool is_empty() const { return next_ == points_ && !list_is_due_; }

 private:
  std::size_t points_;
  std::size_t ahead_ = 0;  // index of the first point that the robot has not passed
  std::size_t next_ = 0;
  bool list_is_due_ = true;
  Restarts of_goto_;
  Restarts of_fuser_;
};

}  // namespace orca::go
