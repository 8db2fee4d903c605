// SPDX-License-Identifier: LGPL-3.0-or-later
#include "boundary.hpp"

#include <algorithm>
#include <utility>

#include "intersect.hpp"
#include "orca/sim/shape.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kAtEnd = 1e-6;  // [m] Generous towards rounding, far below the length of any edge.
constexpr double kTurn = 4.0;    // The bearings of a whole turn.

// Returns the part between -1 and 1 of what goes from one bearing to another to its left, less than half a turn.
// Where it passes half a turn, `to` is the smaller one.
Stretch in_front(double from, double to) {
  if (from <= to) return {std::max(from, -1.0), std::min(to, 1.0)};
  return from < 1.0 ? Stretch{std::max(from, -1.0), 1.0} : Stretch{-1.0, std::min(to, 1.0)};
}

}  // namespace

Boundary::Boundary(const Segment& edge) : a_(edge.a), b_(edge.b) {
  const Vec2 along = b_ - a_;
  const double side = cross(a_, b_);
  const double square = dot(along, along);
  faces_away_ = side > 0.0;
  if (square == 0.0) return;
  foot_ = side / square * Vec2{along.y, -along.x};
  const bool holds_foot = dot(a_, along) <= 0.0 && dot(b_, along) >= 0.0;
  nearest_ = std::sqrt(holds_foot ? dot(foot_, foot_) : std::min(dot(a_, a_), dot(b_, b_)));
  if (nearest_ <= kTouch) {
    seen_ = {-1.0, 1.0};
    return;
  }
  const Vec2 first = side > 0.0 ? a_ : b_;
  const Vec2 last = side > 0.0 ? b_ : a_;
  seen_ = in_front(bearing_of(first), bearing_of(last));
}

Boundary::Boundary(const Circle& circle) : a_(circle.center), radius_(circle.radius) {
  const double square = dot(a_, a_);
  const double away = std::sqrt(square);
  const double tangent = (away - radius_) * (away + radius_);
  faces_away_ = away < radius_;
  nearest_ = std::fabs(away - radius_);
  foot_ = away > 0.0 ? (1.0 - radius_ / away) * a_ : Vec2{radius_, 0.0};
  seen_ = {-1.0, 1.0};
  if (tangent <= 0.0) return;
  const Vec2 turn{std::sqrt(tangent), radius_};
  seen_ = in_front(bearing_of(rotated(a_, Vec2{turn.x, -turn.y})), bearing_of(rotated(a_, turn)));
}

Vec2 Boundary::nearest_to(Vec2 p) const { return nearest_point(Segment{a_, b_}, p); }

// Returns where the edge is met, from 0 at its beginning to 1 at its end. Between the ends of a badly
// conditioned one it is inexact, and never beyond them.
double Boundary::share(Vec2 u) const {
  const double left_a = cross(u, a_);
  const double left_b = cross(u, b_);
  if (left_a == left_b) return dot(u, a_) <= dot(u, b_) ? 0.0 : 1.0;
  return std::min(std::max(left_a / (left_a - left_b), 0.0), 1.0);
}

double Boundary::depth(Vec2 u) const {
  if (!is_edge()) return circle_depth(u);
  const double along_a = dot(u, a_);
  return std::max(0.0, (along_a + share(u) * (dot(u, b_) - along_a)) / dot(u, u));
}

double Boundary::circle_depth(Vec2 u) const {
  const double square = dot(u, u);
  const double across = cross(u, a_);
  const double half = std::sqrt(std::max(0.0, radius_ * radius_ * square - across * across));
  return std::max(0.0, (dot(u, a_) + (faces_away_ ? half : -half)) / square);
}

bool Boundary::ends_at(double bearing) const {
  const Vec2 point = at(bearing);
  return std::min(norm(point - a_), norm(point - b_)) <= kAtEnd;
}

bool Boundary::is_steep(double bearing, double tangent) const {
  const Vec2 u = towards(bearing);
  const Vec2 normal = is_edge() ? Vec2{a_.y - b_.y, b_.x - a_.x} : circle_depth(u) * u - a_;
  return std::fabs(cross(u, normal)) <= tangent * std::fabs(dot(u, normal));
}

std::array<Stretch, 2> Boundary::beyond(double distance) const {
  if (nearest_ >= distance) return {seen_, Stretch{}};
  if (is_edge()) {
    const Vec2 unit = (1.0 / norm(along())) * along();
    const Vec2 half = std::sqrt(std::max(0.0, distance * distance - dot(foot_, foot_))) * unit;
    return faces_away_ ? without(foot_ - half, foot_ + half) : without(foot_ + half, foot_ - half);
  }
  const double square = dot(a_, a_);
  const double reach = (square + distance * distance - radius_ * radius_) / (2.0 * square);
  if (distance * distance >= square - radius_ * radius_) return {};
  const Vec2 near = reach * a_;
  const Vec2 half =
      std::sqrt(std::max(0.0, distance * distance / square - reach * reach)) * Vec2{-a_.y, a_.x};
  return without(near - half, near + half);
}

// Returns what remains of seen() without the part from one point to another to its left. The foot lies between
// the two, which tells where the bearings pass half a turn.
std::array<Stretch, 2> Boundary::without(Vec2 first, Vec2 last) const {
  const double middle = bearing_of(foot_);
  double from = bearing_of(first);
  double to = bearing_of(last);
  if (from > middle) from -= kTurn;
  if (to < middle) to += kTurn;
  return {Stretch{seen_.from, std::min(seen_.to, from)}, Stretch{std::max(seen_.from, to), seen_.to}};
}

Crossings::Crossings(const Boundary& one, const Boundary& other) {
  if (one.is_edge() && other.is_edge()) {
    of_edges(one, other);
  } else if (one.is_edge()) {
    of_edge_and_circle(one, other);
  } else if (other.is_edge()) {
    of_edge_and_circle(other, one);
  } else {
    of_circles(one, other);
  }
  if (count_ == 2 && bearings_[0] > bearings_[1]) std::swap(bearings_[0], bearings_[1]);
}

void Crossings::of_edges(const Boundary& one, const Boundary& other) {
  const double slope = cross(one.along(), other.along());
  if (slope != 0.0) add(one.a_ + cross(other.a_ - one.a_, other.along()) / slope * one.along());
}

void Crossings::of_edge_and_circle(const Boundary& edge, const Boundary& circle) {
  const Vec2 unit = (1.0 / norm(edge.along())) * edge.along();
  const double across = cross(unit, circle.a_ - edge.a_);
  const double square = (circle.radius_ - across) * (circle.radius_ + across);
  if (square < 0.0) return;
  const double middle = dot(unit, circle.a_ - edge.a_);
  add(edge.a_ + (middle - std::sqrt(square)) * unit);
  add(edge.a_ + (middle + std::sqrt(square)) * unit);
}

void Crossings::of_circles(const Boundary& one, const Boundary& other) {
  const Vec2 way = other.a_ - one.a_;
  const double square = dot(way, way);
  if (square == 0.0) return;
  const double place = 0.5 * (1.0 + (one.radius_ - other.radius_) * (one.radius_ + other.radius_) / square);
  const double half = one.radius_ * one.radius_ / square - place * place;
  if (half < 0.0) return;
  const Vec2 aside = std::sqrt(half) * Vec2{-way.y, way.x};
  add(one.a_ + place * way + aside);
  add(one.a_ + place * way - aside);
}

}  // namespace orca::sim::detail
