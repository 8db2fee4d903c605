// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/caster.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "bodies.hpp"
#include "grid.hpp"
#include "orca/base/portable_math.hpp"
#include "panorama.hpp"

namespace orca::sim {
namespace {

// First number of each kind of element.
constexpr std::uint64_t kMesh = 1;
constexpr std::uint64_t kStanding = std::uint64_t{1} << 62U;
constexpr std::uint64_t kBodies = std::uint64_t{2} << 62U;

detail::Elements elements_of(const WorldModel& world) {
  detail::Elements elements;
  for (const Obstacle& o : world.obstacles)
    if (o.mesh == nullptr) elements.add(o.shape, {o.bottom, o.height});
  return elements;
}

// Returns the finishes of the elements in the order of their numbers: the edges' before the circles'. Empty if all are plain.
std::vector<Finish> finishes_of(const WorldModel& world) {
  const auto is_plain = [](const Obstacle& o) { return o.finish == Finish::plain; };
  if (std::ranges::all_of(world.obstacles, is_plain)) return {};
  std::vector<Finish> edges, circles;
  for (const Obstacle& o : world.obstacles) {
    if (o.mesh != nullptr) continue;
    if (std::holds_alternative<Circle>(o.shape)) circles.push_back(o.finish);
    edges.insert(edges.end(), edges_of(o.shape).size(), o.finish);
  }
  edges.insert(edges.end(), circles.begin(), circles.end());
  return edges;
}

constexpr double kMeshSlice = 0.1;  // [m]
constexpr Colour kBlack{36, 36, 38};
constexpr Colour kGlass{188, 212, 216};

std::set<double> heights_of(const WorldModel& world) {
  std::set<double> heights{0.0};
  for (const Obstacle& o : world.obstacles) {
    heights.insert({o.bottom, o.height});
    if (o.mesh == nullptr) continue;
    for (int k = 1; o.bottom + k * kMeshSlice < o.height; ++k) heights.insert(o.bottom + k * kMeshSlice);
  }
  return heights;
}

std::vector<std::shared_ptr<const Mesh>> meshes_of(const WorldModel& world) {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const Obstacle& o : world.obstacles)
    if (o.mesh != nullptr) meshes.push_back(o.mesh);
  return meshes;
}

}  // namespace

struct Caster::Impl {
  explicit Impl(const WorldModel& world)
      : grid(elements_of(world)),
        finishes(finishes_of(world)),
        meshes(meshes_of(world)),
        heights(heights_of(world)) {}
  detail::Grid grid;
  std::vector<Finish> finishes;  // By the numbers of the grid's elements; empty: all are plain.
  detail::MeshSections meshes;
  std::set<double> heights;  // At which what stands begins and ends.
  detail::Bodies bodies;

  // Completes a hit among the bodies by what stands; nothing that stands is nearer than `from` [m].
  void finish(const Ray& ray, Hit& hit, double from) const {
    const double bodies_at = hit.range;
    if (hit.found()) hit.element += kBodies;
    grid.cast(ray, hit, from);
    const double grid_at = hit.range;
    if (grid_at < bodies_at) {
      if (!finishes.empty()) hit.finish = finishes[hit.element];
      hit.element += kStanding;
    }
    meshes.cast(ray, hit);
    if (hit.range < grid_at) {
      hit.element = kMesh;  // Sections at different heights have different edges.
      hit.finish = Finish::plain;
    }
    hit.point = ray.origin + hit.range * ray.direction;
    hit.direction = ray.direction;
  }
};

Caster::Caster(const WorldModel& world) : impl_(std::make_unique<Impl>(world)) {}
Caster::~Caster() = default;
Caster::Caster(Caster&&) noexcept = default;
Caster& Caster::operator=(Caster&&) noexcept = default;

std::size_t Caster::add_body(Body body) { return add_solids({std::move(body)}); }
std::size_t Caster::add_solids(std::vector<Body> solids) { return impl_->bodies.add(std::move(solids)); }
void Caster::move_body(std::size_t number, Shape shape) { impl_->bodies.move(number, std::move(shape)); }
void Caster::move_solids(std::size_t number, std::vector<Body> solids) {
  impl_->bodies.move(number, std::move(solids));
}
void Caster::remove_body(std::size_t number) { impl_->bodies.remove(number); }

Vec2 Hit::along() const {
  if (const auto* edge = std::get_if<Segment>(&surface)) return edge->b - edge->a;
  if (const auto* circle = std::get_if<Circle>(&surface)) {
    const Vec2 normal = point - circle->center;
    return {-normal.y, normal.x};
  }
  return {1.0, 0.0};
}

double Hit::incidence() const {
  const Vec2 surface_along = along();
  return portable::atan2(std::fabs(dot(direction, surface_along)),
                         std::fabs(cross(direction, surface_along)));
}

double Hit::cosine() const {
  const Vec2 surface_along = along();
  return std::fabs(cross(direction, surface_along)) / norm(surface_along);
}

bool Hit::steeper_than(double tangent) const {
  const Vec2 surface_along = along();
  return std::fabs(dot(direction, surface_along)) <= tangent * std::fabs(cross(direction, surface_along));
}

Colour Caster::colour_of(const Hit& hit) const {
  if (hit.element >= kBodies) return impl_->bodies.colour_of(hit.element - kBodies);
  if (hit.finish == Finish::black) return kBlack;
  return hit.finish == Finish::glass ? kGlass : kPlainColour;
}

std::vector<double> Caster::heights() const {
  std::vector<double> all(impl_->heights.begin(), impl_->heights.end());
  impl_->bodies.add_heights(all);
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  return all;
}

Hit Caster::cast(const Ray& ray) const {
  Hit hit;
  hit.range = ray.max_range;
  impl_->bodies.cast(ray, hit);
  impl_->finish(ray, hit, 0.0);
  return hit;
}

void Caster::survey(const Ray& axis, double half_angle, detail::Panorama& view) const {
  const detail::Cone cone(axis.origin, axis.direction, half_angle, 0.0, axis.max_range);
  view.begin(cone, axis.sensor_height);
  impl_->bodies.show(cone, axis.ignore_body, kBodies, view);
  impl_->grid.show(cone, kStanding, 1, view);
  impl_->meshes.show(cone, axis.sensor_height, kMesh, view);
  view.finish();
}

Caster::View::View(const Caster& caster, const Ray& axis, double half_angle, double slack) {
  look(caster, axis, half_angle, slack);
}

void Caster::View::look(const Caster& caster, const Ray& axis, double half_angle, double slack) {
  impl_ = caster.impl_.get();
  const detail::Cone cone(axis.origin, axis.direction, half_angle, slack, axis.max_range);
  empty_to_ = impl_->grid.empty_depth(cone);
  chosen_ = impl_->bodies.choose(axis, cone, bodies_);
}

Hit Caster::View::cast(const Ray& ray) const {
  Hit hit;
  hit.range = ray.max_range;
  if (chosen_) {
    impl_->bodies.cast(ray, bodies_, hit);
  } else {
    impl_->bodies.cast(ray, hit);
  }
  impl_->finish(ray, hit, empty_to_);
  return hit;
}

}  // namespace orca::sim
