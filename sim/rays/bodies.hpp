// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells.hpp"
#include "cone.hpp"
#include "orca/sim/figures.hpp"

namespace orca::sim::detail {

// A set of circles that is searched whole for each cone. Its columns are in single precision, so that the
// compiler handles four circles at once. Rounding may add circles to the result, but never removes one.
class Discs {
 public:
  // Adds or replaces a circle. @param number  the next free one, or one in use.
  void set(std::size_t number, const Circle& circle);

  // Appends to `found` the numbers of all circles that rays of the cone may meet, in ascending order.
  void find_near(const Cone& cone, std::vector<std::uint32_t>& found) const;

 private:
  // The cone in the precision of the columns.
  struct Question {
    explicit Question(const Cone& cone);
    float tip_x, tip_y, left_x, left_y, right_x, right_y, axis_x, axis_y, reach, wider;
  };

  // Marks which of the `count` circles that begin at `first` the cone may meet.
  void mark(const Question& asked, std::size_t first, std::size_t count, std::int32_t* marks) const;

  std::vector<float> x_, y_, radius_;
};

class Panorama;

// The bodies that can move, each of one or more upright solids, listed by the cells of their own uniform grid. Few moves
// change a list, so a move costs little. Cells have one size however far the bodies are apart, and share lists, whose
// number depends on that of the bodies only.
class Bodies {
 public:
  std::size_t add(std::vector<Body> solids);
  void move(std::size_t number, Shape shape);  // Of its first solid.
  void move(std::size_t number, std::vector<Body> solids);
  void remove(std::size_t number);

  // Replaces the hit by the nearest body on the ray if that is closer. Each edge or circle of each body has its own
  // number.
  void cast(const Ray& ray, Hit& hit) const;
  // Does the same for the bodies with these numbers only.
  void cast(const Ray& ray, std::span<const std::uint32_t> numbers, Hit& hit) const;

  // Returns the colour of the body that has an element of that number.
  [[nodiscard]] Colour colour_of(std::uint64_t element) const {
    return bodies_.at(element / kMostEdges).pieces.front().solid.colour;
  }
  // Adds the heights at which solids begin and end.
  void add_heights(std::vector<double>& heights) const;

  // Collects the bodies that rays within the cone can hit; the rays equal the axis but for origin and
  // direction. Returns false if the cone is too wide for the search to pay off.
  bool choose(const Ray& axis, const Cone& cone, std::vector<std::uint32_t>& found) const;

  // Adds to the view of a cone all bodies that can be seen in it but for one, and perhaps some that cannot. The
  // numbers of their elements begin at `first`.
  void show(const Cone& cone, std::size_t without, std::uint64_t first, Panorama& view) const;

 private:
  static constexpr std::uint64_t kMostEdges = 1U << 20U;  // Element numbers reserved for each body.
  static constexpr std::uint64_t kSpreads =
      0x9e3779b97f4a7c15U;  // 2^64 over the golden ratio: spreads the cells.

  // A solid with its edges, which are computed once per move.
  struct Piece {
    explicit Piece(Body b);
    Body solid;
    std::vector<Segment> edges;
    std::uint64_t first = 0;  // Number in the body of its circle or its first edge.
  };
  // A body with its bounds.
  struct Moving {
    explicit Moving(std::vector<Body> solids);
    void set(std::vector<Body> solids);
    // Returns true if the ray meets the body before the hit, and sets the hit to the number of the edge or circle in
    // the body.
    bool cast(const Ray& ray, Hit& hit) const;

    std::vector<Piece> pieces;
    bool present = true;
    Bounds bounds;
    double bottom = 0.0, top = 0.0;  // [m]
    bool is_listed = false;
    Cells::Range listed{};
  };

  // The circle and heights around a body, which rule out most bodies. It is small because rays look at many.
  struct Outer {
    explicit Outer(const Moving& moving);
    [[nodiscard]] bool in_reach(const Ray& ray, double best) const;
    [[nodiscard]] bool at(double height) const { return bottom <= height && height < top; }
    Circle around;
    double bottom, top;  // [m] Equal for a removed body.
  };

  void cast_at(std::size_t number, const Ray& ray, Hit& hit) const;
  void place(std::size_t number);
  void list(std::size_t number);
  void unlist(std::size_t number);
  void choose_cells();
  [[nodiscard]] std::size_t list_of(std::size_t cell) const { return (cell * kSpreads) >> list_shift_; }
  void surround(std::size_t number);

  std::vector<Moving> bodies_;
  std::vector<Outer> outer_;  // One per body.
  Discs discs_;               // The circle around each body.
  Cells cells_;
  // The numbers of the bodies in the cells. Several cells share a list, so that there may be any number of cells.
  std::vector<std::vector<std::uint32_t>> lists_;
  unsigned list_shift_ = 0;               // Leaves as many bits of a cell's product as number the lists.
  std::vector<std::uint32_t> sprawling_;  // Bodies over so many cells that rays look at each.
};

}  // namespace orca::sim::detail
