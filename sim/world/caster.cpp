// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/caster.hpp"

#include <algorithm>
#include <utility>

#include "grid.hpp"
#include "intersect.hpp"

namespace orca::sim {
namespace {

// A body, with its edges and an enclosing circle worked out once per move.
struct Moving {
  explicit Moving(Body b) : body(std::move(b)) { refresh(); }
  void refresh() {
    edges = edges_of(body.shape);
    const Bounds box = bounds_of(body.shape);
    around.center = 0.5 * (box.low + box.high);
    around.radius = 0.5 * norm(box.high - box.low) + detail::kTouch;
  }
  [[nodiscard]] bool out_of_reach(const Ray& ray, double best) const {
    const Vec2 w = around.center - ray.origin;
    return std::fabs(cross(ray.direction, w)) > around.radius ||
           dot(ray.direction, w) + around.radius < 0.0 || dot(ray.direction, w) - around.radius > best;
  }

  Body body;
  std::vector<Segment> edges;
  Circle around;
};

void cast_at(const Moving& moving, const Ray& ray, double& best, Surface& surface) {
  if (const auto* circle = std::get_if<Circle>(&moving.body.shape))
    if (detail::meet(ray.origin, ray.direction, *circle, best)) surface = *circle;
  for (const Segment& e : moving.edges)
    if (detail::meet(ray.origin, ray.direction, e, best)) surface = e;
}

double incidence_on(const Surface& surface, Vec2 hit, Vec2 u) {
  Vec2 along{1.0, 0.0};
  if (const auto* edge = std::get_if<Segment>(&surface)) along = edge->b - edge->a;
  if (const auto* circle = std::get_if<Circle>(&surface)) {
    const Vec2 normal = hit - circle->center;
    along = {-normal.y, normal.x};
  }
  return std::atan2(std::fabs(dot(u, along)), std::fabs(cross(u, along)));
}

}  // namespace

struct Caster::Impl {
  explicit Impl(const WorldModel& world) : grid(world) {}
  detail::Grid grid;
  std::vector<Moving> bodies;
};

Caster::Caster(const WorldModel& world) : impl_(std::make_unique<Impl>(world)) {}
Caster::~Caster() = default;
Caster::Caster(Caster&&) noexcept = default;
Caster& Caster::operator=(Caster&&) noexcept = default;

std::size_t Caster::add_body(Body body) {
  impl_->bodies.emplace_back(std::move(body));
  return impl_->bodies.size() - 1;
}

void Caster::move_body(std::size_t number, Shape shape) {
  Moving& moving = impl_->bodies.at(number);
  moving.body.shape = std::move(shape);
  moving.refresh();
}

Hit Caster::cast(const Ray& ray) const {
  Hit hit;
  hit.range = ray.max_range;
  hit.surface = impl_->grid.cast(ray, hit.range);
  for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
    const Moving& m = impl_->bodies[i];
    if (i == ray.ignore_body || m.body.top <= ray.sensor_height || m.body.bottom > ray.sensor_height)
      continue;
    if (!m.out_of_reach(ray, hit.range)) cast_at(m, ray, hit.range, hit.surface);
  }
  if (hit.found())
    hit.incidence = incidence_on(hit.surface, ray.origin + hit.range * ray.direction, ray.direction);
  return hit;
}

}  // namespace orca::sim
