// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/collision/rigid_body.hpp"

#include <algorithm>
#include <utility>

#include "solver.hpp"

namespace orca::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Returns a length that is smaller by kTouch at both ends.
double less(double length) { return std::max(length - 2.0 * RigidBody::kTouch, RigidBody::kTouch); }

struct Piece {
  Geometry geometry;
  Isometry3d X_BS;
};

}  // namespace

struct RigidBody::Pieces {
  std::vector<Piece> all;
};

RigidBody::RigidBody() : pieces_(std::make_unique<Pieces>()) {}
RigidBody::~RigidBody() = default;
RigidBody::RigidBody(RigidBody&&) noexcept = default;
RigidBody& RigidBody::operator=(RigidBody&&) noexcept = default;

void RigidBody::add_block(const Isometry3d& X_BS, const Vector3d& lengths) {
  const Vector3d smaller{less(lengths.x()), less(lengths.y()), less(lengths.z())};
  pieces_->all.push_back({solver().block(smaller), X_BS});
}

void RigidBody::add_cylinder(const Isometry3d& X_BS, double radius, double length) {
  pieces_->all.push_back({solver().cylinder(0.5 * less(2.0 * radius), less(length)), X_BS});
}

void RigidBody::add_ball(const Vector3d& middle, double radius) {
  Isometry3d X_BS = Isometry3d::Identity();
  X_BS.translation() = middle;
  pieces_->all.push_back({solver().ball(0.5 * less(2.0 * radius)), X_BS});
}

void RigidBody::add_hull(std::vector<Vector3d> corners) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : corners) middle += p / static_cast<double>(corners.size());
  for (Vector3d& p : corners) p -= std::min(kTouch, (p - middle).norm()) * (p - middle).normalized();
  pieces_->all.push_back({solver().hull(std::move(corners), {}), Isometry3d::Identity()});
}

void RigidBody::add_surface(const std::vector<Facet>& facets) {
  if (!facets.empty()) pieces_->all.push_back({solver().surface(facets), Isometry3d::Identity()});
}

bool RigidBody::meets(const RigidBody& other, const Isometry3d& X_BO) const {
  return std::ranges::any_of(pieces_->all, [&](const Piece& a) {
    return std::ranges::any_of(other.pieces_->all, [&](const Piece& b) {
      return solver().meet(a.geometry, a.X_BS, b.geometry, X_BO * b.X_BS);
    });
  });
}

}  // namespace orca::collision
