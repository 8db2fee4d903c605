// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/collision/rigid_body.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <utility>

namespace orca::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Returns a length that is smaller by kTouch at both ends.
double less(double length) { return std::max(length - 2.0 * RigidBody::kTouch, RigidBody::kTouch); }

struct Piece {
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
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
  const auto box = std::make_shared<fcl::Boxd>(less(lengths.x()), less(lengths.y()), less(lengths.z()));
  pieces_->all.push_back({box, X_BS});
}

void RigidBody::add_cylinder(const Isometry3d& X_BS, double radius, double length) {
  pieces_->all.push_back({std::make_shared<fcl::Cylinderd>(0.5 * less(2.0 * radius), less(length)), X_BS});
}

void RigidBody::add_ball(const Vector3d& middle, double radius) {
  Isometry3d X_BS = Isometry3d::Identity();
  X_BS.translation() = middle;
  pieces_->all.push_back({std::make_shared<fcl::Sphered>(0.5 * less(2.0 * radius)), X_BS});
}

// FCL takes points without faces for a hull: then it looks at all of them for the farthest in a direction.
void RigidBody::add_hull(std::vector<Vector3d> corners) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : corners) middle += p / static_cast<double>(corners.size());
  for (Vector3d& p : corners) p -= std::min(kTouch, (p - middle).norm()) * (p - middle).normalized();
  const auto points = std::make_shared<const std::vector<Vector3d>>(std::move(corners));
  const auto hull = std::make_shared<fcl::Convexd>(points, 0, std::make_shared<const std::vector<int>>());
  pieces_->all.push_back({hull, Isometry3d::Identity()});
}

void RigidBody::add_surface(const std::vector<Facet>& facets) {
  if (facets.empty()) return;
  const auto surface = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  surface->beginModel(static_cast<int>(facets.size()), static_cast<int>(3 * facets.size()));
  for (const Facet& facet : facets) surface->addTriangle(facet[0], facet[1], facet[2]);
  surface->endModel();
  pieces_->all.push_back({surface, Isometry3d::Identity()});
}

bool RigidBody::meets(const RigidBody& other, const Isometry3d& X_BO) const {
  const auto meet = [&](const Piece& a, const Piece& b) {
    fcl::CollisionResultd result;
    return fcl::collide(a.geometry.get(), a.X_BS, b.geometry.get(), X_BO * b.X_BS, fcl::CollisionRequestd(),
                        result) > 0;
  };
  return std::ranges::any_of(pieces_->all, [&](const Piece& a) {
    return std::ranges::any_of(other.pieces_->all, [&](const Piece& b) { return meet(a, b); });
  });
}

}  // namespace orca::collision
