// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "boundary.hpp"
#include "cone.hpp"
#include "orca/sim/caster.hpp"

namespace orca::sim::detail {

// What a sensor sees of a cone: in each direction the nearest boundary. It is exact: whatever is seen has its
// stretch of bearings, however narrow, and whatever is hidden has none.
//
// The cone opens upwards and downwards as far as to both sides. What reaches the sensor's height makes the first
// view. What lies above or below comes in further views, level by level: a level holds the boundaries with the same
// difference to the sensor's height. They are seen from where the cone reaches that height. They are hidden by what
// stands before them at any height from the sensor's to their own.
//
// All vectors are in the frame of the cone: its tip is the origin, its axis the x axis.
class Panorama {
 public:
  // A part of the view in which the same boundary is seen, or nothing.
  struct Patch {
    double from, to;     // Bearings.
    std::uint32_t what;  // Number of the boundary, or kNothing.
    double far;          // [m] Nothing of it is farther; infinite for kNothing and for a circle from inside.
  };
  static constexpr std::uint32_t kNothing = 0xffffffff;

  // Begins anew with an empty cone.
  // @pre  the rims are at most a right angle from the axis.
  void begin(const Cone& cone, double sensor_height);

  // Adds a boundary in the world frame that reaches from `bottom` to `top` [m].
  template <class Figure>
  void add(const Figure& figure, std::uint64_t element, double bottom, double top);

  // Returns the distance [m] beyond which boundaries change nothing.
  [[nodiscard]] double far() const { return far_; }
  // Returns false if nothing between these heights [m] can lie in the cone.
  [[nodiscard]] bool may_show(double bottom, double top) const {
    return bottom < top && bottom <= height_ + rise_ && top >= height_ - rise_;
  }

  // Ends the additions. The first view is that at the sensor's own height.
  void finish();
  // Goes on to the view of the next level. Returns false if there is none.
  bool next_level();

  // Returns the present view from right to left, without gaps.
  [[nodiscard]] std::span<const Patch> patches() const { return patches_; }
  // Returns the difference [m] between the sensor's height and where the level's boundaries are nearest to it.
  [[nodiscard]] double rise() const { return level_.rise; }
  // Returns true if the patch shows a boundary of the present level. Other patches hide what is behind them.
  [[nodiscard]] bool is_of_level(const Patch& patch) const {
    return patch.what >= level_.first && patch.what < level_.last;
  }
  [[nodiscard]] const Boundary& boundary(const Patch& patch) const { return things_[patch.what].boundary; }
  // Returns the boundary of the patch in the world frame.
  [[nodiscard]] const Surface& surface(const Patch& patch) const { return things_[patch.what].surface; }
  // Returns the number of the boundary's element.
  [[nodiscard]] std::uint64_t element(const Patch& patch) const { return things_[patch.what].element; }

  // Returns the patch at a bearing of the first view.
  [[nodiscard]] const Patch& first_patch_at(double bearing) const;
  // Returns true if nothing of the first view stands before the point, or less than `slack` [m] before it. The
  // point is in the world frame and lies in the cone, or beyond its end.
  [[nodiscard]] bool shows(Vec2 point, double slack) const;
  // Returns in the world frame a direction that is given in the frame of the cone.
  [[nodiscard]] Vec2 in_world(Vec2 v) const { return rotated(v, axis_); }

  // Memory for the numbers of the bodies that are looked at.
  [[nodiscard]] std::vector<std::uint32_t>& numbers() { return numbers_; }

 private:
  struct Thing {
    Thing(const Boundary& seen, const Surface& world, std::uint64_t number, double above)
        : boundary(seen), surface(world), element(number), rise(above) {}
    Boundary boundary;
    Surface surface;
    std::uint64_t element;
    double rise;  // [m] Above the sensor, negative if below; 0 at its height.
  };
  struct Level {
    double rise = 0.0;
    std::uint32_t first = 0, last = 0;
  };

  [[nodiscard]] Vec2 local(Vec2 p) const {
    const Vec2 w = p - tip_;
    return {dot(axis_, w), cross(axis_, w)};
  }
  [[nodiscard]] Segment local(const Segment& s) const { return {local(s.a), local(s.b)}; }
  [[nodiscard]] Circle local(const Circle& c) const { return {local(c.center), c.radius}; }
  [[nodiscard]] bool misses(const Segment& edge) const;
  [[nodiscard]] bool misses(const Circle& circle) const;

  bool insert(std::uint32_t what, const Stretch& seen);
  void drop_narrow_patches();
  bool contest(std::uint32_t what, const Patch& held, const Stretch& seen);
  // Returns true if the two have at most one point in common, so that whichever is nearer at both ends of a
  // stretch is nearer between them.
  [[nodiscard]] bool cross_once(std::uint32_t one, std::uint32_t other) const {
    return things_[one].boundary.is_edge() && things_[other].boundary.is_edge();
  }
  [[nodiscard]] bool is_nearer(std::uint32_t what, std::uint32_t than, double bearing) const;
  [[nodiscard]] double far_of(double from, double to, std::uint32_t what) const;
  void append(double from, double to, std::uint32_t what);
  void append(const Patch& patch);

  Vec2 tip_, axis_;
  Vec2 rim_;              // Direction of the left rim, of length 1.
  Stretch opening_;       // From rim to rim.
  double reach_ = 0.0;    // [m]
  double height_ = 0.0;   // [m]
  double rise_ = 0.0;     // [m] The cone's largest difference to its height.
  double tangent_ = 0.0;  // Slope of the rims.
  double far_ = 0.0;

  std::vector<Thing> things_;
  std::vector<Thing> apart_;  // What lies above and below, sorted by finish().
  std::size_t next_apart_ = 0;
  Level level_;
  std::vector<Patch> patches_;
  std::vector<Patch> changed_;  // The patches that an insertion leaves.
  std::vector<Patch> first_;    // The first view.
  std::vector<std::uint32_t> numbers_;
};

}  // namespace orca::sim::detail
