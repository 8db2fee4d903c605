// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/robot_model.hpp"
#include "tick_span.hpp"

namespace orca::sim::detail {

// A level pinhole camera without any error. It sees the sides of things up to kSight, shaded by how slanted they are seen, before a plain floor and
// ceiling. Things have no upper or lower faces: who looks into one from above sees its far side.
class CameraModel {
 public:
  static constexpr double kSight = 15.0;  // [m]

  CameraModel(Camera camera, TimePoint start);

  // Takes the picture that is due in the span, if one is.
  void run(const Caster& caster, std::size_t own_body, const TickSpan& span);

  // Returns the picture that was taken in the last run(), if one was.
  [[nodiscard]] const std::optional<CameraShot>& completed() const { return completed_; }

 private:
  // A part of the space in which everything is upright, between two heights [m].
  struct Slice {
    double bottom = 0.0;
    double top = 0.0;
  };
  // The side of something in a column, at a distance along the camera's axis [m].
  struct Side {
    double depth = 0.0;
    Slice slice{};
    Colour colour{};
  };
  struct Rows {
    std::uint32_t first = 0, end = 0;
  };
  // Rows of a column that show one side, or nothing.
  struct Piece {
    Rows rows{};
    std::optional<Colour> colour{};
  };
  // What the rays of a column have in common.
  struct Column {
    Vec2 origin{};
    Vec2 direction{};
    double range_per_depth = 1.0;
    std::size_t own_body = 0;
  };

  void slice(const std::vector<double>& heights);
  void look(const Caster& caster, const Column& column);
  double find_sides(const Caster& caster, const Column& column, const Slice& slice, double depth);
  void add_runs(CameraShot& shot);
  [[nodiscard]] std::uint32_t row_of(double height, double depth) const;

  const Camera camera_;
  const double focal_length_;  // [pixels]
  TimePoint due_;
  std::vector<Slice> below_,
      above_;  // The slice of the camera itself, from there downwards, from there upwards.
  Slice level_;
  std::vector<Side> sides_;              // Of the present column.
  std::vector<Rows> free_, still_free_;  // Its rows that show no side so far.
  std::vector<Piece> pieces_;
  std::optional<CameraShot> completed_;
};

}  // namespace orca::sim::detail
