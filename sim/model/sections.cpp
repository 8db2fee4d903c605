// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/sections.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "orca/base/portable_math.hpp"
#include "part_frame.hpp"

namespace orca::sim {
namespace {

constexpr double kLevel = 1e-9;  // Largest sine of the angle between axes that count as parallel.
constexpr unsigned kSides = 128;
constexpr std::size_t kMostPoints = 4096;  // More are reduced to their hull.

// What of the parts counts: one height, at which bottom <= height < top, or what lies strictly between two.
struct Slab {
  double low, high;
  [[nodiscard]] bool is_plane() const { return low == high; }
  [[nodiscard]] bool meets(double bottom, double top) const {
    return is_plane() ? bottom <= low && low < top : bottom < high && low < top;
  }
};

constexpr Slab kEverything{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

bool is_steep(const Vec3& axis) { return portable::hypot(axis.x, axis.y) < kLevel; }
bool is_level(const Vec3& axis) { return std::fabs(axis.z) < kLevel; }

std::vector<Vec3> corners_of_block(const Part::Block& b) {
  std::vector<Vec3> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.push_back(
        {(i & 1U ? 0.5 : -0.5) * b.x, (i & 2U ? 0.5 : -0.5) * b.y, (i & 4U ? 0.5 : -0.5) * b.z});
  return corners;
}

// Returns the corners of the prism around the cylinder; number 2 k lies at the lower end of side k, number
// 2 k + 1 at its upper end.
std::vector<Vec3> corners_of_prism(const Part::Cylinder& c) {
  const double outer = c.radius / portable::cos(std::numbers::pi / kSides);
  std::vector<Vec3> corners;
  for (unsigned k = 0; k < kSides; ++k) {
    const Vec2 p = outer * direction(2.0 * std::numbers::pi * k / kSides);
    corners.push_back({p.x, p.y, -0.5 * c.length});
    corners.push_back({p.x, p.y, 0.5 * c.length});
  }
  return corners;
}

std::vector<Vec3> corners_in_base(const Part& part) {
  std::vector<Vec3> corners;
  if (const auto* block = std::get_if<Part::Block>(&part.form)) corners = corners_of_block(*block);
  if (const auto* cylinder = std::get_if<Part::Cylinder>(&part.form)) corners = corners_of_prism(*cylinder);
  if (const auto* hull = std::get_if<Part::Hull>(&part.form)) corners = hull->corners;
  const detail::PartFrame frame(part.X_BP);
  for (Vec3& p : corners) p = frame.in_base(p);
  return corners;
}

bool is_edge_of_prism(unsigned i, unsigned j) {
  if (i / 2 == j / 2) return true;
  const unsigned steps = (j / 2 + kSides - i / 2) % kSides;
  return i % 2 == j % 2 && (steps == 1 || steps == kSides - 1);
}

// Returns true if the line between two corners may be an edge. Those of a hull are not known; a line through its
// inside does no harm.
bool may_be_edge(const Part& part, std::size_t i, std::size_t j) {
  const auto a = static_cast<unsigned>(i), b = static_cast<unsigned>(j);
  if (std::holds_alternative<Part::Block>(part.form)) return std::has_single_bit(a ^ b);
  return std::holds_alternative<Part::Hull>(part.form) || is_edge_of_prism(a, b);
}

// The convex hull of points that are added one by one.
class Plan {
 public:
  void add(Vec2 p) {
    points_.push_back(p);
    if (points_.size() < limit_) return;
    points_ = hull_of(std::move(points_));
    limit_ = std::max(kMostPoints, 2 * points_.size());
  }
  // Returns the hull, or nothing if it has no area.
  [[nodiscard]] std::optional<Shape> outline() && {
    if (points_.size() < 3) return std::nullopt;
    std::vector<Vec2> corners = hull_of(std::move(points_));
    if (corners.size() < 3) return std::nullopt;
    return outline_of(std::move(corners));
  }

 private:
  std::vector<Vec2> points_;
  std::size_t limit_ = kMostPoints;
};

// Adds the point in which the line between two corners passes a height, if it does. Both points at equal x and y
// give that x and y bit for bit.
void add_crossing(const Vec3& one, const Vec3& other, double height, Plan& plan) {
  const Vec3& below = one.z <= other.z ? one : other;
  const Vec3& above = one.z <= other.z ? other : one;
  if (!(below.z <= height && above.z > height)) return;
  const double share = (height - below.z) / (above.z - below.z);
  plan.add({below.x + share * (above.x - below.x), below.y + share * (above.y - below.y)});
}

std::optional<Shape> cut_corners(const Part& part, const Slab& slab) {
  const std::vector<Vec3> corners = corners_in_base(part);
  Plan plan;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& p = corners[i];
    if (!slab.is_plane() && p.z >= slab.low && p.z <= slab.high) plan.add({p.x, p.y});
    for (std::size_t j = 0; j < i; ++j) {
      if (!may_be_edge(part, i, j)) continue;
      add_crossing(p, corners[j], slab.low, plan);
      if (!slab.is_plane()) add_crossing(p, corners[j], slab.high, plan);
    }
  }
  return std::move(plan).outline();
}

// Returns half the width of a circle of that radius around height `middle` where it is widest within the range [m].
double half_width(double radius, double middle, const Slab& slab) {
  const double away = middle - std::clamp(middle, slab.low, slab.high);
  return std::sqrt(std::max(0.0, (radius - away) * (radius + away)));
}

std::optional<Shape> cut_ball(const Part::Ball& ball, const Pose3& X, const Slab& slab) {
  const double radius = half_width(ball.radius, X.z, slab);
  if (radius == 0.0) return std::nullopt;
  return Circle{{X.x, X.y}, radius};
}

std::optional<Shape> cut_level_cylinder(const Part::Cylinder& c, const Pose3& X, const Vec3& axis,
                                        const Slab& slab) {
  const double half = half_width(c.radius, X.z, slab);
  if (half == 0.0) return std::nullopt;
  const Vec2 middle{X.x, X.y};
  const Vec2 along = 0.5 * c.length * Vec2{axis.x, axis.y};
  const Vec2 aside = half * Vec2{-axis.y, axis.x};
  return outline_of(
      {middle - along - aside, middle + along - aside, middle + along + aside, middle - along + aside});
}

std::optional<Shape> cut(const Part& part, const Slab& slab) {
  const auto [bottom, top] = height_range_of(part);
  if (!slab.meets(bottom, top)) return std::nullopt;
  const Pose3& X = part.X_BP;
  if (const auto* ball = std::get_if<Part::Ball>(&part.form)) return cut_ball(*ball, X, slab);
  if (const auto* c = std::get_if<Part::Cylinder>(&part.form)) {
    const Vec3 axis = detail::PartFrame(X).axis(2);
    if (is_steep(axis)) return Circle{{X.x, X.y}, c->radius};
    if (is_level(axis)) return cut_level_cylinder(*c, X, axis, slab);
  }
  // All sections of an upright block are its plan; rounding must not empty those at its ends.
  return cut_corners(part, is_upright(part) ? kEverything : slab);
}

std::vector<Shape> cut_all(const std::vector<Part>& parts, const Slab& slab) {
  std::vector<Shape> plans;
  for (const Part& part : parts)
    if (auto plan = cut(part, slab)) plans.push_back(std::move(*plan));
  return plans;
}

}  // namespace

std::vector<Shape> sections_at(const std::vector<Part>& parts, double height) {
  return cut_all(parts, {height, height});
}

std::vector<Shape> sections_of(const RobotModel& robot, const std::vector<std::string>& links,
                               double height) {
  std::vector<Part> chosen;
  for (const Part& part : robot.parts)
    if (std::ranges::find(links, part.link) != links.end()) chosen.push_back(part);
  return sections_at(chosen, height);
}

std::vector<Shape> plans_between(const std::vector<Part>& parts, double low, double high) {
  return low < high ? cut_all(parts, {low, high}) : std::vector<Shape>{};
}

std::pair<double, double> height_range_of(const Part& part) {
  const detail::PartFrame frame(part.X_BP);
  const auto rise = [&](std::size_t axis) { return std::fabs(frame.axis(axis).z); };
  if (const auto* hull = std::get_if<Part::Hull>(&part.form)) {
    std::pair range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Vec3& p : hull->corners) {
      const double z = frame.in_base(p).z;
      range = {std::min(range.first, z), std::max(range.second, z)};
    }
    return range;
  }
  double reach = 0.0;
  if (const auto* b = std::get_if<Part::Block>(&part.form))
    reach = 0.5 * (rise(0) * b->x + rise(1) * b->y + rise(2) * b->z);
  if (const auto* c = std::get_if<Part::Cylinder>(&part.form))
    reach = 0.5 * c->length * rise(2) + c->radius * portable::hypot(frame.axis(0).z, frame.axis(1).z);
  if (const auto* ball = std::get_if<Part::Ball>(&part.form)) reach = ball->radius;
  return {part.X_BP.z - reach, part.X_BP.z + reach};
}

bool is_upright(const Part& part) {
  const detail::PartFrame frame(part.X_BP);
  if (std::holds_alternative<Part::Cylinder>(part.form)) return is_steep(frame.axis(2));
  if (!std::holds_alternative<Part::Block>(part.form)) return false;
  return is_steep(frame.axis(0)) || is_steep(frame.axis(1)) || is_steep(frame.axis(2));
}

std::vector<Shape> RobotModel::section_at(double height) const { return sections_at(parts, height); }

}  // namespace orca::sim
