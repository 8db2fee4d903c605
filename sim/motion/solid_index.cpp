// SPDX-License-Identifier: LGPL-3.0-or-later
#include "solid_index.hpp"

#include <algorithm>
#include <utility>

namespace orca::sim::detail {
namespace {

Bounds bounds_of(const Rounded& plan) {
  Bounds bounds;
  for (const Vec2& corner : plan.corners) bounds.add(Circle{corner, plan.radius});
  return bounds;
}

// Adds where an edge of a triangle lies between two heights.
void add_between(const Vec3& a, const Vec3& b, double low, double high, std::vector<Vec2>& points) {
  const double rise = b.z - a.z;
  const auto at = [&](double z) {
    const double share = rise == 0.0 ? 0.0 : (z - a.z) / rise;
    return Vec2{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
  };
  if (a.z >= low && a.z <= high) points.push_back({a.x, a.y});
  for (const double z : {low, high})
    if ((a.z < z && b.z > z) || (a.z > z && b.z < z)) points.push_back(at(z));
}

std::vector<Vec2> corners_between(const Triangle& t, double low, double high) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < 3; ++k) add_between(t[k], t[(k + 1) % 3], low, high, points);
  return points.size() < 2 ? points : hull_of(std::move(points));
}

struct Visitor final : btDbvt::ICollide {
  explicit Visitor(const std::function<void(std::size_t)>& visit) : visit_(visit) {}
  void Process(const btDbvtNode* leaf) override { visit_(static_cast<std::size_t>(leaf->dataAsInt)); }

 private:
  const std::function<void(std::size_t)>& visit_;
};

}  // namespace

Rounded plan_between(const Solid& solid, double low, double high) {
  if (solid.bottom >= high || solid.top <= low) return {};
  if (solid.triangle == nullptr) return solid.plan;
  return {corners_between(*solid.triangle, low, high), 0.0};
}

btDbvtVolume volume_of(const Bounds& area) {
  return btDbvtVolume::FromMM(btVector3(area.low.x, area.low.y, -1.0),
                              btVector3(area.high.x, area.high.y, 1.0));
}

SolidIndex::SolidIndex(const WorldModel& world) {
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    const Obstacle& o = world.obstacles[i];
    if (o.mesh == nullptr) {
      for (Rounded& plan : solids_of(o.shape)) add({std::move(plan), o.bottom, o.height, i});
      continue;
    }
    for (const Triangle& t : o.mesh->triangles) {
      const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
      add({{corners_between(t, low, high), 0.0}, low, high, i, &t});
    }
  }
  tree_.optimizeTopDown();
}

void SolidIndex::add(Solid solid) {
  btDbvtNode* const leaf = tree_.insert(volume_of(bounds_of(solid.plan)), nullptr);
  leaf->dataAsInt = static_cast<int>(solids_.size());
  solids_.push_back(std::move(solid));
}

void SolidIndex::visit(const Bounds& area, const std::function<void(const Solid&)>& visit) {
  const std::function<void(std::size_t)> of_number = [&](std::size_t number) { visit(solids_[number]); };
  Visitor visitor(of_number);
  tree_.collideTV(tree_.m_root, volume_of(area), visitor);
}

}  // namespace orca::sim::detail
