// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/collision/swept_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/arc.hpp"
#include "solver.hpp"

namespace orca::collision {
namespace {

constexpr double kNoNearer =
    0.001;  // [m] by which a body may come nearer to what is within its margin: rounding, no more.
constexpr double kThin = 1e-4;  // [m] half the width of a post. FCL has no solid without one.

double length_of(Vec2 way) { return std::sqrt(dot(way, way)); }

// A line along an edge of a plan.
struct Edge {
  Vec2 outward;   // of length 1
  double offset;  // [m] of the line, from the origin outward
};

// A solid as FCL wants it: around its own middle.
struct Shape {
  Solid solid;
  Vec2 middle;              // of the circle that holds the plan
  double radius{0.0};       // [m] of that circle
  std::vector<Edge> edges;  // none: the circle is the plan
  Geometry geometry;
  Eigen::Isometry3d place;
};

bool is_solid(const Solid& solid) {
  return solid.bottom < solid.top &&
         (solid.corners.size() >= 3 || (solid.corners.size() == 1 && solid.radius > 0.0));
}

Vec2 middle_of(const std::vector<Vec2>& corners) {
  Vec2 low = corners.front();
  Vec2 high = low;
  for (const Vec2 p : corners) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return 0.5 * (low + high);
}

// Returns the prism over a plan: below its corners, and above them.
Geometry prism(const std::vector<Vec2>& corners, double height) {
  const auto sides = static_cast<int>(corners.size());
  std::vector<Eigen::Vector3d> points;
  for (const double z : {-0.5 * height, 0.5 * height})
    for (const Vec2 p : corners) points.emplace_back(p.x, p.y, z);
  std::vector<int> faces{sides};
  for (int i = sides; i-- > 0;) faces.push_back(i);
  faces.push_back(sides);
  for (int i = 0; i < sides; ++i) faces.push_back(sides + i);
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    faces.insert(faces.end(), {4, i, next, sides + next, sides + i});
  }
  return solver().hull(std::move(points), {sides + 2, std::move(faces)});
}

Eigen::Isometry3d placed(Vec2 where, double z) {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation() << where.x, where.y, z;
  return place;
}

Shape shape_of(const Solid& solid) {
  const double height = solid.top - solid.bottom;
  Shape shape{.solid = solid, .middle = middle_of(solid.corners), .edges = {}, .geometry = {}, .place = {}};
  shape.place = placed(shape.middle, 0.5 * (solid.bottom + solid.top));
  if (solid.corners.size() == 1) {
    shape.radius = solid.radius;
    shape.geometry = solver().cylinder(solid.radius, height);
    return shape;
  }
  std::vector<Vec2> around;
  for (const Vec2 p : solid.corners) {
    around.push_back(p - shape.middle);
    shape.radius = std::max(shape.radius, norm(around.back()));
  }
  for (std::size_t i = 0; i < solid.corners.size(); ++i) {
    const Vec2 along = solid.corners[(i + 1) % solid.corners.size()] - solid.corners[i];
    if (length_of(along) == 0.0) continue;
    const Vec2 outward = (1.0 / length_of(along)) * Vec2{along.y, -along.x};
    shape.edges.push_back({outward, dot(solid.corners[i], outward)});
  }
  shape.geometry = prism(around, height);
  return shape;
}

// Returns how far a place is from the edge of the plan [m]; negative within. Too little beside a corner, exact elsewhere.
double off_plan(const Shape& shape, Vec2 where) {
  if (shape.edges.empty()) return length_of(where - shape.middle) - shape.radius;
  double most = -std::numeric_limits<double>::infinity();
  for (const Edge& edge : shape.edges) most = std::max(most, dot(where, edge.outward) - edge.offset);
  return most;
}

// Returns how far a post is from a solid at least [m]. It is the distance itself, but for posts beside a corner; negative only within.
double at_least(const Shape& shape, const Post& post) {
  const double above = std::max({0.0, post.bottom - shape.solid.top, shape.solid.bottom - post.top});
  double aside = off_plan(shape, post.place);
  if (aside > 0.0 && !shape.edges.empty())
    aside = std::max(aside, length_of(post.place - shape.middle) - shape.radius);
  if (above > 0.0) return std::sqrt(above * above + std::max(0.0, aside) * std::max(0.0, aside));
  return aside;
}

// Returns the distance of a solid and a post by FCL [m]; where they share a point, the way out sideways as a negative number.
double distance(const Shape& shape, const Post& post) {
  // What a post has beyond the solid's own height changes nothing but the shape that FCL computes with.
  const double bottom = std::max(post.bottom, shape.solid.bottom - Approach::kFar);
  const double top = std::min(post.top, shape.solid.top + Approach::kFar);
  if (bottom >= top) return Approach::kFar;
  const double apart =
      solver().distance(shape.geometry, shape.place, {2.0 * kThin, 2.0 * kThin, top - bottom},
                        placed(post.place, 0.5 * (bottom + top)));
  return apart > 0.0 ? apart : std::min(0.0, off_plan(shape, post.place));
}

}  // namespace

struct SweptBody::Shapes {
  std::vector<Shape> all;

  // Returns the distance [m] to a post at least; `most` or more if it is not nearer than that.
  [[nodiscard]] double at_least(const Post& post, double most = Approach::kFar) const {
    double least = most;
    for (const Shape& shape : all) {
      const Vec2 off = post.place - shape.middle;
      const double beyond = std::max(0.0, least) + shape.radius;
      if (dot(off, off) >= beyond * beyond) continue;  // all of its plan is farther away
      least = std::min(least, collision::at_least(shape, post));
    }
    return least;
  }
  // Returns the distance [m] to a post, at most kFar.
  [[nodiscard]] double distance(const Post& post) const {
    double least = Approach::kFar;
    for (const Shape& shape : all)
      if (collision::at_least(shape, post) < least) least = std::min(least, collision::distance(shape, post));
    return least;
  }
};

namespace {

// A post during a motion.
struct Neighbour {
  Post post;
  std::size_t index;
  double allowed;   // [m] the distance that it must keep
  double distance;  // [m] its distance at least, when it was looked at last
  double at;        // [1] the share of the motion at which that was
};

}  // namespace

// A motion of a body past posts.
class SweptBody::Motion {
 public:
  // @param length  [m] that no point of the body goes more than.
  Motion(const Shapes& shapes, const Travel2& travel, double length)
      : shapes_(shapes), travel_(travel), length_(length) {}

  // Adds a post, unless the motion cannot come near to it.
  void add(const Post& post, std::size_t index, double margin) {
    const double least = shapes_.at_least(post, Approach::kFar + length_);
    if (least >= Approach::kFar + length_) return;
    if (least >= margin) return near_.push_back({post, index, margin, least, 0.0});
    const double there = shapes_.distance(post);
    if (there < -kOwn) return;
    near_.push_back({post, index, std::min(margin, there - kNoNearer), there, 0.0});
  }

  // Steps on by a little less than as much as no post can come too near meanwhile: a long step must not end too near by a rounding.
  Approach advance() {
    std::ranges::sort(near_, {}, &Neighbour::distance);
    for (double share = 0.0; look(share) && share < 1.0;) {
      approach_.share = share;
      share = std::min(1.0, share + std::max(spare_ - 0.5 * kStep, kStep) / length_);
    }
    if (!approach_.post) approach_.share = 1.0;
    return approach_;
  }

 private:
  // Looks how much each post has to spare at least. Returns whether none is too near.
  bool look(double share) {
    spare_ = std::numeric_limits<double>::infinity();
    X_ = along_arc({}, {share * travel_.forward, share * travel_.left, share * travel_.turn});
    back_ = direction(-X_.yaw);
    for (Neighbour& neighbour : near_) {
      // Since it was looked at it can have come nearer by the way that the farthest point has gone.
      const double least = neighbour.distance - (share - neighbour.at) * length_;
      if (least - neighbour.allowed >= spare_ && least > approach_.clearance) continue;
      measure(neighbour, share);
      if (neighbour.distance < neighbour.allowed) {
        approach_.post = neighbour.index;
        return false;
      }
      spare_ = std::min(spare_, neighbour.distance - neighbour.allowed);
    }
    return true;
  }

  // FCL is asked only where the distance decides something.
  void measure(Neighbour& neighbour, double share) {
    const Post seen{rotated(neighbour.post.place - X_.position(), back_), neighbour.post.bottom,
                    neighbour.post.top};
    neighbour.at = share;
    neighbour.distance = shapes_.at_least(seen);
    if (neighbour.distance - neighbour.allowed > kStep && neighbour.distance > approach_.clearance - kStep)
      return;
    neighbour.distance = shapes_.distance(seen);
    if (neighbour.distance >= neighbour.allowed)
      approach_.clearance = std::min(approach_.clearance, neighbour.distance);
  }

  const Shapes& shapes_;
  const Travel2 travel_;
  const double length_;
  std::vector<Neighbour> near_;
  Pose2 X_;             // of the body now
  Vec2 back_;           // direction of the posts' x axis, seen from it
  double spare_ = 0.0;  // [m] until the next post is too near, at least
  Approach approach_;
};

SweptBody::SweptBody(std::span<const Solid> solids) {
  auto shapes = std::make_unique<Shapes>();
  for (const Solid& solid : solids) {
    if (!is_solid(solid)) continue;
    shapes->all.push_back(shape_of(solid));
    const Shape& shape = shapes->all.back();
    reach_ = std::max(reach_, norm(shape.middle) + shape.radius);
  }
  shapes_ = std::move(shapes);
}

SweptBody::~SweptBody() = default;
SweptBody::SweptBody(SweptBody&&) noexcept = default;
SweptBody& SweptBody::operator=(SweptBody&&) noexcept = default;

bool SweptBody::is_empty() const { return shapes_->all.empty(); }

double SweptBody::distance(const Post& post) const { return shapes_->distance(post); }

double SweptBody::plan_distance(Vec2 place) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Shape& shape : shapes_->all) least = std::min(least, at_least(shape, {place}));
  return least;
}

Approach SweptBody::along(const Travel2& travel, std::span<const Post> posts, double margin) const {
  const double length = portable::hypot(travel.forward, travel.left) + reach_ * std::fabs(travel.turn);
  Motion motion(*shapes_, travel, length);
  for (std::size_t i = 0; i < posts.size(); ++i) motion.add(posts[i], i, margin);
  return motion.advance();
}

}  // namespace orca::collision
