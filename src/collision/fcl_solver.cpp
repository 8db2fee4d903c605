// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <utility>

#include "solver.hpp"

namespace orca::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

class FclSolver final : public Solver {
 public:
  [[nodiscard]] Geometry block(const Vector3d& lengths) const override {
    return std::make_shared<fcl::Boxd>(lengths);
  }
  [[nodiscard]] Geometry cylinder(double radius, double length) const override {
    return std::make_shared<fcl::Cylinderd>(radius, length);
  }
  [[nodiscard]] Geometry ball(double radius) const override { return std::make_shared<fcl::Sphered>(radius); }
  [[nodiscard]] Geometry hull(std::vector<Vector3d> points, Faces faces) const override {
    return std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<Vector3d>>(std::move(points)),
                                          faces.count,
                                          std::make_shared<const std::vector<int>>(std::move(faces.corners)));
  }
  [[nodiscard]] Geometry surface(const std::vector<Facet>& facets) const override {
    const auto surface = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    surface->beginModel(static_cast<int>(facets.size()), static_cast<int>(3 * facets.size()));
    for (const Facet& facet : facets) surface->addTriangle(facet[0], facet[1], facet[2]);
    surface->endModel();
    return surface;
  }

  [[nodiscard]] bool meet(const Geometry& a, const Isometry3d& X_WA, const Geometry& b,
                          const Isometry3d& X_WB) const override {
    fcl::CollisionResultd result;
    return fcl::collide(a.get(), X_WA, b.get(), X_WB, fcl::CollisionRequestd(), result) > 0;
  }
  [[nodiscard]] double distance(const Geometry& a, const Isometry3d& X_WA, const Vector3d& lengths,
                                const Isometry3d& X_WB) const override {
    const fcl::Boxd block(lengths);
    fcl::DistanceRequestd request;
    request.gjk_solver_type = fcl::GST_LIBCCD;
    fcl::DistanceResultd result;
    return fcl::distance(a.get(), X_WA, &block, X_WB, request, result);
  }
};

}  // namespace

extern "C" [[gnu::visibility("default")]] const Solver& orca_fcl_solver() {
  static const FclSolver solver;
  return solver;
}

}  // namespace orca::collision
