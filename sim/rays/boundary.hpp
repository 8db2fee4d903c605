// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "bearing.hpp"
#include "orca/sim/figures.hpp"

namespace orca::sim::detail {

// An edge or a circle as it is seen from the origin of its frame, in the plane.
class Boundary {
 public:
  explicit Boundary(const Segment& edge);
  explicit Boundary(const Circle& circle);

  [[nodiscard]] bool is_edge() const { return radius_ < 0.0; }
  // Returns true if the origin lies on the side of the solid.
  [[nodiscard]] bool faces_away() const { return faces_away_; }
  // Returns the bearings that it covers, as far as they lie between -1 and 1.
  [[nodiscard]] const Stretch& seen() const { return seen_; }
  // Returns the distance of its nearest point [m].
  [[nodiscard]] double nearest() const { return nearest_; }
  // Returns the nearest point of the whole line or of the circle.
  [[nodiscard]] Vec2 foot() const { return foot_; }
  // The ends of an edge. @pre  is_edge()
  [[nodiscard]] Vec2 a() const { return a_; }
  [[nodiscard]] Vec2 b() const { return b_; }
  [[nodiscard]] Vec2 middle() const { return 0.5 * (a_ + b_); }
  // Returns an edge's direction, of the edge's length. @pre  is_edge()
  [[nodiscard]] Vec2 along() const { return b_ - a_; }
  // Returns the point of the edge that is nearest to `p`. @pre  is_edge()
  [[nodiscard]] Vec2 nearest_to(Vec2 p) const;

  // Returns how far it is towards `u`, in lengths of `u`. @pre  seen() holds the bearing of `u`.
  [[nodiscard]] double depth(Vec2 u) const;
  // Returns where it is met at a bearing. @pre  seen() holds the bearing.
  [[nodiscard]] Vec2 at(double bearing) const {
    const Vec2 u = towards(bearing);
    return depth(u) * u;
  }
  // Returns true if an end of the edge lies at the bearing, or less than a micrometre beside it. @pre  is_edge()
  [[nodiscard]] bool ends_at(double bearing) const;
  // Returns true if the angle between the normal and the line of sight at a bearing has at most this tangent.
  [[nodiscard]] bool is_steep(double bearing, double tangent) const;

  // Returns the parts of seen() in which it is at least so far away [m]; from outside only.
  [[nodiscard]] std::array<Stretch, 2> beyond(double distance) const;

 private:
  [[nodiscard]] double share(Vec2 u) const;
  [[nodiscard]] double circle_depth(Vec2 u) const;
  [[nodiscard]] std::array<Stretch, 2> without(Vec2 first, Vec2 last) const;

  friend class Crossings;

  Vec2 a_, b_;            // The ends of an edge; a_ is the centre of a circle.
  double radius_ = -1.0;  // [m] Negative: it is an edge.
  bool faces_away_ = false;
  Stretch seen_;
  double nearest_ = 0.0;
  Vec2 foot_;
};

// The bearings at which two boundaries may meet. Bearings at which they do not may be among them.
class Crossings {
 public:
  Crossings(const Boundary& one, const Boundary& other);
  [[nodiscard]] const double* begin() const { return bearings_.data(); }
  [[nodiscard]] const double* end() const { return bearings_.data() + count_; }

 private:
  void add(Vec2 point) { bearings_[count_++] = bearing_of(point); }
  void of_edges(const Boundary& one, const Boundary& other);
  void of_edge_and_circle(const Boundary& edge, const Boundary& circle);
  void of_circles(const Boundary& one, const Boundary& other);

  std::array<double, 2> bearings_{};
  std::size_t count_ = 0;
};

}  // namespace orca::sim::detail
