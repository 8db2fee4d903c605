// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bodies.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>
#include <utility>

#include "intersect.hpp"
#include "marks.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kCell = 1.0;   // [m] The size of a few robots.
constexpr double kRoom = 10.0;  // [m] Margin around all bodies, so that they rarely leave the cells.
constexpr double kMostInARow =
    4e4;  // Over so many cells of a walk, rounding errors sum up to 1e-6 m at most.
constexpr std::size_t kMostListed = 4096;  // A body over more cells is in no cell's list.
constexpr std::size_t kListsPerBody = 8;   // At least: rays look at few bodies of other cells.
constexpr unsigned kFewestListBits = 10;
constexpr std::size_t kFew = 6;  // Up to this many bodies, testing each is faster than walking the cells.
// Up to this many bodies, a view chooses among them; with more, each ray finds its own through the cells.
constexpr std::size_t kMany = 300;
constexpr double kWide = 0.25 * std::numbers::pi;  // [rad] The half angle of a view is smaller.

template <class Visit>
void for_cells_of(const Cells& cells, const Cells::Range& range, const Visit& visit) {
  for (int r = range.first_row; r <= range.last_row; ++r)
    for (int c = range.first_column; c <= range.last_column; ++c) visit(cells.cell(c, r));
}

// Number of circles that are marked at a time.
constexpr std::size_t kBlock = 64;
static_assert(kBlock % kMarkGroup == 0);

}  // namespace

Bodies::Piece::Piece(Body b) : solid(std::move(b)), edges(edges_of(solid.shape)) {}

Bodies::Moving::Moving(std::vector<Body> solids) { set(std::move(solids)); }

void Bodies::Moving::set(std::vector<Body> solids) {
  pieces.clear();
  bounds = {};
  bottom = solids.front().bottom;
  top = solids.front().top;
  std::uint64_t number = 0;
  for (Body& solid : solids) {
    bottom = std::min(bottom, solid.bottom);
    top = std::max(top, solid.top);
    Piece& piece = pieces.emplace_back(std::move(solid));
    piece.first = number;
    number += std::max(std::size_t{1}, piece.edges.size());
    const Bounds around = bounds_of(piece.solid.shape);
    bounds.add(around.low);
    bounds.add(around.high);
  }
}

Bodies::Outer::Outer(const Moving& moving)
    : around{0.5 * (moving.bounds.low + moving.bounds.high), 0.0},
      bottom(moving.bottom),
      top(moving.present ? moving.top : moving.bottom) {
  for (const Piece& piece : moving.pieces) {
    if (const auto* circle = std::get_if<Circle>(&piece.solid.shape))
      around.radius = std::max(around.radius, norm(circle->center - around.center) + circle->radius);
    for (const Segment& edge : piece.edges)
      around.radius = std::max(around.radius, norm(edge.a - around.center));
  }
  around.radius += kTouch;
}

bool Bodies::Outer::in_reach(const Ray& ray, double best) const {
  if (!at(ray.sensor_height)) return false;
  const Vec2 w = around.center - ray.origin;
  const double along = dot(ray.direction, w);
  return std::fabs(cross(ray.direction, w)) <= around.radius && along + around.radius >= 0.0 &&
         along - around.radius <= best;
}

bool Bodies::Moving::cast(const Ray& ray, Hit& hit) const {
  bool met = false;
  const auto test = [&](const auto& boundary, std::uint64_t number) {
    if (!meet(ray.origin, ray.direction, boundary, hit.range)) return;
    hit.surface = boundary;
    hit.element = number;
    met = true;
  };
  for (const Piece& piece : pieces) {
    if (!(piece.solid.bottom <= ray.sensor_height && ray.sensor_height < piece.solid.top)) continue;
    if (const auto* circle = std::get_if<Circle>(&piece.solid.shape)) test(*circle, piece.first);
    for (std::size_t i = 0; i < piece.edges.size(); ++i) test(piece.edges[i], piece.first + i);
  }
  return met;
}

// Updates the circle and heights around a body after the body has changed.
void Bodies::surround(std::size_t number) {
  outer_[number] = Outer(bodies_[number]);
  discs_.set(number, outer_[number].around);
}

std::size_t Bodies::add(std::vector<Body> solids) {
  const std::size_t number = bodies_.size();
  outer_.emplace_back(bodies_.emplace_back(std::move(solids)));
  surround(number);
  if (kListsPerBody * bodies_.size() > lists_.size()) choose_cells();
  place(number);
  return number;
}

void Bodies::move(std::size_t number, Shape shape) {
  std::vector<Body> solids;
  for (const Piece& piece : bodies_.at(number).pieces) solids.push_back(piece.solid);
  solids.front().shape = std::move(shape);
  move(number, std::move(solids));
}

void Bodies::move(std::size_t number, std::vector<Body> solids) {
  Moving& moving = bodies_.at(number);
  moving.set(std::move(solids));
  surround(number);
  if (!moving.present) return;
  if (cells_.hold(moving.bounds) && cells_.range(moving.bounds) == moving.listed) return;
  unlist(number);
  place(number);
}

void Bodies::remove(std::size_t number) {
  Moving& moving = bodies_.at(number);
  if (moving.present) unlist(number);
  moving.present = false;
  surround(number);
}

void Bodies::add_heights(std::vector<double>& heights) const {
  for (const Moving& moving : bodies_) {
    if (!moving.present) continue;
    for (const Piece& piece : moving.pieces)
      heights.insert(heights.end(), {piece.solid.bottom, piece.solid.top});
  }
}

void Bodies::place(std::size_t number) {
  if (!cells_.hold(bodies_[number].bounds)) choose_cells();
  list(number);
}

// Chooses cells and lists for all bodies, and lists them, except those that are not placed yet.
void Bodies::choose_cells() {
  Bounds all;
  for (const Moving& m : bodies_) {
    if (!m.present) continue;
    all.add(m.bounds.low);
    all.add(m.bounds.high);
  }
  // Adds half the extent to each side: for a body that keeps moving away this happens ever more seldom.
  const Vec2 room = Vec2{kRoom, kRoom} + 0.5 * (all.high - all.low);
  all.add(all.low - room);
  all.add(all.high + room);
  const Vec2 side = all.high - all.low;
  cells_ = Cells(all, std::max({kCell, side.x / kMostInARow, side.y / kMostInARow}));
  const unsigned bits =
      std::max(kFewestListBits, static_cast<unsigned>(std::bit_width(kListsPerBody * bodies_.size())));
  list_shift_ = 64 - bits;
  lists_.assign(std::size_t{1} << bits, {});
  sprawling_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].present && bodies_[i].is_listed) list(i);
}

void Bodies::list(std::size_t number) {
  Moving& moving = bodies_[number];
  moving.is_listed = true;
  moving.listed = cells_.range(moving.bounds);
  const auto small = static_cast<std::uint32_t>(number);
  if (moving.listed.count() > kMostListed) return sprawling_.push_back(small);
  for_cells_of(cells_, moving.listed, [&](std::size_t c) { lists_[list_of(c)].push_back(small); });
}

void Bodies::unlist(std::size_t number) {
  Moving& moving = bodies_[number];
  moving.is_listed = false;
  const auto small = static_cast<std::uint32_t>(number);
  if (moving.listed.count() > kMostListed) {
    std::erase(sprawling_, small);
    return;
  }
  for_cells_of(cells_, moving.listed, [&](std::size_t c) { std::erase(lists_[list_of(c)], small); });
}

void Bodies::cast_at(std::size_t number, const Ray& ray, Hit& hit) const {
  if (outer_[number].in_reach(ray, hit.range) && bodies_[number].cast(ray, hit))
    hit.element += number * kMostEdges;
}

void Bodies::cast(const Ray& ray, Hit& hit) const {
  const auto test = [&](std::size_t number) {
    if (number != ray.ignore_body) cast_at(number, ray, hit);
  };
  if (bodies_.size() <= kFew) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) test(i);
    return;
  }
  for (const std::uint32_t number : sprawling_) test(number);
  cells_.walk(ray, 0.0, hit.range, [&](std::size_t cell) {
    for (const std::uint32_t number : lists_[list_of(cell)]) test(number);
  });
}

void Bodies::cast(const Ray& ray, std::span<const std::uint32_t> numbers, Hit& hit) const {
  for (const std::uint32_t number : numbers) cast_at(number, ray, hit);
}

bool Bodies::choose(const Ray& axis, const Cone& cone, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (cone.half_angle > kWide || bodies_.size() <= kFew || bodies_.size() > kMany) return false;
  discs_.find_near(cone, found);
  std::erase_if(found, [&](std::uint32_t number) {
    return number == axis.ignore_body || !outer_[number].at(axis.sensor_height);
  });
  return true;
}

void Discs::set(std::size_t number, const Circle& circle) {
  if (number >= x_.size())
    for (auto* column : {&x_, &y_, &radius_}) column->resize(number + 1);
  x_[number] = single(circle.center.x);
  y_[number] = single(circle.center.y);
  radius_[number] = single(circle.radius + single_margin(circle.center));
}

void Discs::find_near(const Cone& cone, std::vector<std::uint32_t>& found) const {
  const Question asked(cone);
  std::array<std::int32_t, kBlock> marks;
  for (std::size_t first = 0; first < x_.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, x_.size() - first);
    mark(asked, first, count, marks.data());
    for_all_marked(marks.data(), count,
                   [&](std::size_t i) { found.push_back(static_cast<std::uint32_t>(first + i)); });
  }
}

Discs::Question::Question(const Cone& cone) {
  tip_x = single(cone.tip.x);
  tip_y = single(cone.tip.y);
  left_x = single(cone.left.x);
  left_y = single(cone.left.y);
  right_x = single(cone.right.x);
  right_y = single(cone.right.y);
  axis_x = single(cone.axis.x);
  axis_y = single(cone.axis.y);
  reach = single(cone.reach);
  wider = single(cone.slack + single_margin(cone.tip));
}

void Discs::mark(const Question& asked, std::size_t first, std::size_t count, std::int32_t* marks) const {
  const Question one = asked;
  const float* const X = x_.data() + first;
  const float* const Y = y_.data() + first;
  const float* const R = radius_.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = X[i] - one.tip_x;
    const float y = Y[i] - one.tip_y;
    const float radius = R[i] + one.wider;
    const float along = one.axis_x * x + one.axis_y * y;
    // The circle lies outside neither rim, and neither behind the tip nor beyond the end.
    marks[i] = (one.left_x * y - one.left_y * x <= radius) & (one.right_x * y - one.right_y * x >= -radius) &
               (along >= -radius) & (along <= one.reach + radius);
  }
}

}  // namespace orca::sim::detail
