// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <tuple>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/navigation/footprint.hpp"
#include "orca/navigation/pure_pursuit.hpp"

namespace orca::nav {

/// The way out of a place where nothing leads on: backwards along the way that the robot has come; if that is not free, along the
/// freest of some arcs backwards; if there is none, or if the robot does not move although it should, likewise forwards.
///
/// The robot never leaves the floor that it knows: that which it has driven over lately, and that which its sensors have seen.
/// So a robot that has just been switched on, and does not see what is behind it, does not back off.
///
/// Thread contract: one thread at a time.
class Retreat {
 public:
  /// Returns whether the sensors have seen what is at a point, given in the frame of the poses: nothing, or one of the obstacles of the scene.
  using Seen = std::function<bool(Vec2)>;

  explicit Retreat(const Footprint& footprint) : footprint_(footprint) {}

  /// Notes that the robot is there, on its own way.
  void note(const Pose2& pose);
  /// Begins a retreat, which leads the way that the last one led in the end.
  void begin();
  /// Returns the next moment of it. It is blocked if no way leads out, or none any more.
  [[nodiscard]] Steer step(TimePoint now, const Scene& scene, const Seen& seen);
  /// Names what it knows, but for the footprint.
  [[nodiscard]] auto state() {
    return std::tie(trail_, left_, direction_, has_turned_back_, has_moved_, retreated_, stood_at_,
                    moved_at_);
  }

  /// Forgets that there was no way out backwards.
  void reset() { direction_ = -1.0; }

 private:
  // The facts of one step.
  struct View {
    const Scene& scene;
    const Seen& seen;
  };
  [[nodiscard]] Steer way_out(const View& view);
  [[nodiscard]] std::optional<double> curvature_of_trail(const Pose2& pose);
  [[nodiscard]] double free_way(const View& view, double curvature, double margin) const;
  [[nodiscard]] bool is_known(const View& view, const Pose2& place) const;
  [[nodiscard]] bool has_covered(const Pose2& pose, Vec2 point) const;
  [[nodiscard]] bool stays(TimePoint now, Vec2 place);
  [[nodiscard]] Steer drive(double curvature) const;

  Footprint footprint_;
  std::vector<Pose2> trail_;      // oldest first
  std::size_t left_ = 0;          // of the trail, how much of it leads on backwards
  double direction_ = -1.0;       // +1: forwards
  bool has_turned_back_ = false;  // in this retreat it has tried the other direction
  bool has_moved_ = false;        // in this retreat
  bool retreated_ = false;        // since the robot was on its own way
  Vec2 stood_at_;
  std::optional<TimePoint> moved_at_;
};

}  // namespace orca::nav
