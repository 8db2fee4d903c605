// SPDX-License-Identifier: LGPL-3.0-or-later
#include "camera_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace orca::sim::detail {
namespace {

constexpr double kNextSide = 1e-6;  // [m] The next side begins at least so far behind the last.
constexpr int kMostSides = 32;      // Of a slice in a column.
constexpr double kDarkest = 0.6;    // Share of its colour that a side shows which is seen along itself.

// @param cosine  of the angle at which the side is seen.
Colour shaded(Colour colour, double cosine) {
  const double share = kDarkest + (1.0 - kDarkest) * cosine;
  const auto part = [&](std::uint8_t of) { return static_cast<std::uint8_t>(share * of + 0.5); };
  return {part(colour.red), part(colour.green), part(colour.blue)};
}

}  // namespace

CameraModel::CameraModel(Camera camera, TimePoint start)
    : camera_(std::move(camera)), focal_length_(camera_.focal_length()), due_(start + camera_.period) {}

void CameraModel::run(const Caster& caster, std::size_t own_body, const TickSpan& span) {
  completed_.reset();
  if (due_ > span.to) return;
  slice(caster.heights());
  const Pose2 X_WC = span.at(due_) * camera_.center;
  const Vec2 ahead = direction(X_WC.yaw);
  const Vec2 left{-ahead.y, ahead.x};
  CameraShot shot{.stamp = due_, .X_RB = span.in_robot(due_)};
  for (std::size_t i = 0; i < camera_.width; ++i) {
    const double aside = 0.5 * static_cast<double>(camera_.width) - static_cast<double>(i) - 0.5;
    const Vec2 way = ahead + (aside / focal_length_) * left;
    look(caster, {X_WC.position(), (1.0 / norm(way)) * way, norm(way), own_body});
    add_runs(shot);
  }
  completed_ = std::move(shot);
  due_ += camera_.period;
}

// Sorts the slices by how far they are from the height of the camera.
void CameraModel::slice(const std::vector<double>& heights) {
  below_.clear();
  above_.clear();
  const double eye = camera_.link_height;
  const auto over = std::ranges::upper_bound(heights, eye);
  level_ = {over == heights.begin() ? 0.0 : *std::prev(over),
            over == heights.end() ? std::numeric_limits<double>::infinity() : *over};
  for (auto it = over; it != heights.end() && std::next(it) != heights.end(); ++it)
    above_.push_back({*it, *std::next(it)});
  if (over == heights.begin()) return;
  for (auto it = std::prev(over); it != heights.begin(); --it) below_.push_back({*std::prev(it), *it});
}

// Finds the sides that a column may show. The first side at the camera's own height hides all behind it; below and above, sight reaches farther the
// farther a slice is from there, because it passes under and over that side.
void CameraModel::look(const Caster& caster, const Column& column) {
  sides_.clear();
  const double limit = kSight / column.range_per_depth;
  const double eye = camera_.link_height;
  const double first = find_sides(caster, column, level_, limit);
  const auto go_out = [&](const std::vector<Slice>& slices, double near_edge) {
    double reach = first;
    double edge = near_edge;
    for (const Slice& slice : slices) {
      const double far_edge = std::max(std::fabs(slice.bottom - eye), std::fabs(slice.top - eye));
      reach = edge > 0.0 ? std::min(limit, reach * far_edge / edge) : limit;
      find_sides(caster, column, slice, reach);
      edge = far_edge;
    }
  };
  go_out(below_, eye - level_.bottom);
  go_out(above_, level_.top - eye);
}

// Returns the depth of the first side in the slice, or `depth`.
double CameraModel::find_sides(const Caster& caster, const Column& column, const Slice& slice, double depth) {
  const double height = std::isfinite(slice.top) ? 0.5 * (slice.bottom + slice.top) : slice.bottom;
  double nearest = depth;
  double from = 0.0;
  for (int i = 0; i < kMostSides; ++i) {
    const double ahead = depth * column.range_per_depth - from;
    if (ahead <= 0.0) break;
    const Hit hit = caster.cast(
        {column.origin + from * column.direction, column.direction, ahead, height, column.own_body});
    if (!hit.found()) break;
    const double at = (from + hit.range) / column.range_per_depth;
    nearest = std::min(nearest, at);
    sides_.push_back({at, slice, shaded(caster.colour_of(hit), hit.cosine())});
    if (&slice == &level_) break;
    from += hit.range + kNextSide;
  }
  return nearest;
}

// Adds the runs of the present column: the nearest side comes first, and each has what those before it leave free.
void CameraModel::add_runs(CameraShot& shot) {
  std::ranges::stable_sort(sides_, {}, &Side::depth);
  pieces_.clear();
  free_.assign(1, {0, static_cast<std::uint32_t>(camera_.height)});
  for (const Side& side : sides_) {
    const Rows rows{row_of(side.slice.top, side.depth), row_of(side.slice.bottom, side.depth)};
    still_free_.clear();
    for (const Rows& gap : free_) {
      const Rows seen{std::max(gap.first, rows.first), std::min(gap.end, rows.end)};
      if (seen.first >= seen.end) {
        still_free_.push_back(gap);
        continue;
      }
      pieces_.push_back({seen, side.colour});
      if (gap.first < seen.first) still_free_.push_back({gap.first, seen.first});
      if (seen.end < gap.end) still_free_.push_back({seen.end, gap.end});
    }
    free_.swap(still_free_);
  }
  for (const Rows& gap : free_) pieces_.push_back({gap, std::nullopt});
  std::ranges::sort(pieces_, {}, [](const Piece& piece) { return piece.rows.first; });
  shot.starts.push_back(shot.runs.size());
  for (const Piece& piece : pieces_) shot.runs.push_back({piece.rows.end, piece.colour});
}

// Returns the first row whose middle is at that height or below it.
std::uint32_t CameraModel::row_of(double height, double depth) const {
  const double rows = static_cast<double>(camera_.height);
  const double row = 0.5 * rows - focal_length_ * (height - camera_.link_height) / depth - 0.5;
  return static_cast<std::uint32_t>(std::clamp(std::ceil(row), 0.0, rows));
}

}  // namespace orca::sim::detail
