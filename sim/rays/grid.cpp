// SPDX-License-Identifier: LGPL-3.0-or-later
#include "grid.hpp"

#include <utility>

#include "intersect.hpp"
#include "strips.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
// Largest number of cells that are searched for a cone: a wide search over small cells costs more than the
// rays.
constexpr int kMostLooks = 128;

// Returns how far a cone is empty in a region [m].
// @param looks  number of cells that were searched before, and then of all.
double empty_depth_in(const CellLists& lists, const Cone& cone, int& looks) {
  Strips strips(lists.cells(), cone);
  while (looks < kMostLooks && strips.begin() < cone.reach) {
    const double depth = strips.begin();
    bool filled = false;
    strips.next([&](std::size_t c) {
      filled = filled || !lists.is_empty(c);
      ++looks;
    });
    if (filled) return depth;
  }
  return std::min(strips.begin(), cone.reach);
}

constexpr std::size_t kMaxSections = 64;

}  // namespace

void Grid::cast(const Ray& ray, Hit& hit, double from) const {
  std::uint32_t nearest = kNone;
  const auto test = [&](const auto& boundary, Heights heights, std::uint32_t element) {
    double range = hit.range;
    if (!meet(ray.origin, ray.direction, boundary, range) || !heights.hold(ray.sensor_height)) return;
    hit.range = range;
    nearest = element;
  };
  const std::size_t edges = elements_.edges.size();  // Counted once, because its size is found by a division.
  const auto test_number = [&](std::uint32_t number) {
    if (number < edges) {
      const Elements::Edge& e = elements_.edges[number];
      test(e.segment, e.heights, number);
    } else {
      const Elements::Round& r = elements_.rounds[number - edges];
      test(r.circle, r.heights, number);
    }
  };
  regions_.cross(ray, hit.range, [&](const CellLists& lists) {
    lists.cells().walk(ray, from, hit.range, [&](std::size_t cell) {
      for (const std::uint32_t number : lists.at(cell)) test_number(number);
    });
  });
  if (nearest == kNone) return;
  hit.element = nearest;
  elements_.with(
      nearest, [&](const Elements::Edge& e) { hit.surface = e.segment; },
      [&](const Elements::Round& r) { hit.surface = r.circle; });
}

double Grid::empty_depth(const Cone& cone) const {
  if (cone.half_angle > Strips::kWide) return 0.0;
  double depth = cone.reach;
  int looks = 0;
  regions_.survey(
      cone, [&](const CellLists& lists) { depth = std::min(depth, empty_depth_in(lists, cone, looks)); });
  return depth;
}

std::shared_ptr<const Grid> MeshSections::at(double height) const {
  const MutexLock lock(mutex_);
  if (const auto known = sections_.find(height); known != sections_.end()) return known->second;
  Elements elements;
  for (const auto& mesh : meshes_)
    elements.add(section_of(*mesh, height), {height, std::numeric_limits<double>::infinity()});
  // A cast that uses a section keeps it alive, so erasing it here is safe.
  if (sections_.size() == kMaxSections) sections_.erase(sections_.begin());
  return sections_[height] = std::make_shared<const Grid>(std::move(elements));
}

}  // namespace orca::sim::detail
