// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::collision {

/// One solid of a robot: an upright prism over a convex plan, in the frame of the robot.
struct Solid {
  std::vector<Vec2> corners;  ///< [m] of the plan, counter-clockwise; a single one is the middle of a circle.
  double radius = 0.0;        ///< [m] of that circle.
  double bottom = 0.0;        ///< [m] above the floor.
  double top = 0.0;           ///< [m] above the floor, more than `bottom`.
};

/// Something in the way: an upright line between two heights.
struct Post {
  Vec2 place;                                            ///< [m]
  double bottom = 0.0;                                   ///< [m] above the floor.
  double top = std::numeric_limits<double>::infinity();  ///< [m] above the floor.
};

/// The part of a motion that is free, and what ends it.
struct Approach {
  double share = 1.0;       ///< [1] of the motion before a post comes nearer than the margin.
  double clearance = kFar;  ///< [m] least distance of body and posts on that part, to kStep; at most kFar.
  std::optional<std::size_t> post = {};  ///< The post that ends it; nothing: all of the motion is free.
  static constexpr double kFar = 0.3;    ///< [m]
};

/// The body of a robot that moves along an arc past posts. FCL measures the distances.
///
/// A post that is nearer than the margin at the beginning does not hold the robot, but the robot must not come nearer to it: it may
/// leave, it may not deepen. A post deeper than kOwn within a solid is the robot itself or an error, and is left out.
///
/// Thread contract: immutable; its functions may be called from several threads.
class SweptBody {
 public:
  static constexpr double kOwn = 0.05;    ///< [m]
  static constexpr double kStep = 0.002;  ///< [m]

  /// @pre  each solid has one corner and a radius > 0, or at least three corners that are not on one line, and bottom < top. Others are
  ///       left out.
  explicit SweptBody(std::span<const Solid> solids);
  ~SweptBody();
  SweptBody(SweptBody&&) noexcept;
  SweptBody& operator=(SweptBody&&) noexcept;

  /// Returns whether there is any solid.
  [[nodiscard]] bool is_empty() const;
  /// Returns the radius [m] of the circle around the origin that holds all solids.
  [[nodiscard]] double reach() const { return reach_; }
  /// Returns the distance [m] of the body to a post, both in the frame of the robot: 0 or negative within, by the way out sideways.
  [[nodiscard]] double distance(const Post& post) const;
  /// Returns the distance [m] of the body's plan to a place at any height, in the frame of the robot: exact beside an edge, too little
  /// beside a corner, negative within.
  [[nodiscard]] double plan_distance(Vec2 place) const;
  /// Returns how much of a motion is free, to kStep of the way of the body's farthest point.
  /// @param travel  from the frame in which the posts are given, along an arc.
  /// @param margin  [m] to keep from posts.
  /// @source  Conservative advancement: Mirtich, "Impulse-based Dynamic Simulation of Rigid Body Systems", 1996.
  [[nodiscard]] Approach along(const Travel2& travel, std::span<const Post> posts, double margin) const;

 private:
  struct Shapes;
  class Motion;
  std::unique_ptr<const Shapes> shapes_;
  double reach_ = 0.0;
};

}  // namespace orca::collision
