// SPDX-License-Identifier: GPL-3.0-or-later
// The caster against answers in closed form that share nothing with it: boxes by slabs, cylinders by the
// quadratic formula, polygons by the normal form of their sides, meshes by ray and triangle in space; one
// after the other, without a grid. Many of the rays are aimed at corners, along sides and past cylinders.
#include <catch2/catch.hpp>

#include <algorithm>
#include <iostream>

#include "angles.hpp"
#include "meshes.hpp"
#include "orca/sim/caster.hpp"

using namespace orca::sim;
using orca::direction;
using orca::rotated;
using orca::Vec2;
using orca::sim::test::kPi;

namespace {

constexpr double kExact = 1e-3;    // [m] Largest difference between the answers.
constexpr double kSure = 1e-7;     // [m] Larger differences are only allowed at a corner.
constexpr double kGrazing = 1e-8;  // [m] A ray that passes a corner this closely may meet it or not.
constexpr double kSide = 12.0;     // [m] Side of the closed room around everything.

// Computes the nearest hit, with all solids larger by `growth` on all sides.
class Reference {
 public:
  Reference(const Ray& ray, double growth) : ray_(ray), growth_(growth), best_(ray.max_range) {}

  void see(const Shape& shape, double bottom, double top) {
    if (ray_.sensor_height < bottom || ray_.sensor_height >= top) return;
    if (const auto* circle = std::get_if<Circle>(&shape)) round(*circle);
    if (const auto* box = std::get_if<Box>(&shape)) slabs(*box);
    if (const auto* outline = std::get_if<Outline>(&shape))
      for (const Segment& s : outline->edges) side(s);
  }

  // Möller and Trumbore, J. Graphics Tools 2(1), 1997.
  void see(const Triangle& t) {
    const Vec3 e = minus(t[1], t[0]);
    const Vec3 f = minus(t[2], t[0]);
    const Vec3 u{ray_.direction.x, ray_.direction.y, 0.0};
    const Vec3 p = times(u, f);
    const double det = inner(e, p);
    if (det == 0.0) return;
    const Vec3 s = minus({ray_.origin.x, ray_.origin.y, ray_.sensor_height}, t[0]);
    const Vec3 q = times(s, e);
    const double v = inner(s, p) / det;
    const double w = inner(u, q) / det;
    const double margin = growth_ / size(t);
    if (v >= -margin && w >= -margin && v + w <= 1.0 + margin) offer(inner(f, q) / det);
  }

  [[nodiscard]] double range() const { return best_; }

 private:
  static Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  static double inner(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static Vec3 times(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  // Returns the least height of the triangle over a side, which converts a length to a barycentric coordinate.
  static double size(const Triangle& t) {
    const Vec3 e = minus(t[1], t[0]);
    const Vec3 f = minus(t[2], t[0]);
    const Vec3 g = minus(t[2], t[1]);
    const Vec3 area = times(e, f);
    return std::sqrt(inner(area, area) / std::max({inner(e, e), inner(f, f), inner(g, g)}));
  }
  void offer(double t) {
    if (t >= 0.0) best_ = std::min(best_, t);
  }
  void round(const Circle& c) {
    const Vec2 m = ray_.origin - c.center;
    const double b = dot(m, ray_.direction);
    const double discriminant = b * b - dot(m, m) + (c.radius + growth_) * (c.radius + growth_);
    if (discriminant < 0.0) return;
    offer(-b - std::sqrt(discriminant));
    offer(-b + std::sqrt(discriminant));
  }
  void slabs(const Box& box) {
    const Vec2 o = rotated(ray_.origin - box.pose.position(), -box.pose.yaw);
    const Vec2 u = rotated(ray_.direction, -box.pose.yaw);
    double enter = -1e9;
    double leave = 1e9;
    for (const auto& [start, along, half] :
         {std::array{o.x, u.x, box.half.x + growth_}, std::array{o.y, u.y, box.half.y + growth_}}) {
      if (along == 0.0 && std::fabs(start) > half) return;
      if (along == 0.0) continue;
      enter = std::max(enter, (-std::copysign(half, along) - start) / along);
      leave = std::min(leave, (std::copysign(half, along) - start) / along);
    }
    if (enter > leave) return;
    offer(enter);
    offer(leave);
  }
  void side(const Segment& s) {
    const Vec2 along = 1.0 / norm(s.b - s.a) * (s.b - s.a);
    const Vec2 normal{-along.y, along.x};
    const double slope = dot(normal, ray_.direction);
    if (slope == 0.0) return;
    const double t = dot(normal, s.a - ray_.origin) / slope;
    const double place = dot(along, ray_.origin + t * ray_.direction - s.a);
    // Grown across the ray, as corners are.
    const double margin = growth_ / std::fabs(slope);
    if (place >= -margin && place <= norm(s.b - s.a) + margin) offer(t);
  }

  const Ray& ray_;
  double growth_;
  double best_;
};

// A closed room with everything in it that a caster knows, and some of it moving.
struct Scene {
  explicit Scene(orca::RandomStream& random) {
    Outline walls = outline_of({{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}});
    for (Segment& e : walls.edges) e = {e.b, e.a};
    add("walls", walls, 0.0, 3.0);
    for (int i = 0; i < 8; ++i) {
      add("box", box(random), random.uniform(0, 0.5), random.uniform(0.5, 1));
      add("post", circle(random), random.uniform(0, 0.5), random.uniform(0.5, 1));
    }
    for (int i = 0; i < 3; ++i) add("polygon", polygon(random), 0.0, 1.0);
    for (int i = 0; i < 3; ++i) {
      const Vec2 p = place(random);
      world.obstacles.push_back(
          mesh_obstacle("boulder", test::boulder(random, {p.x, p.y, 0.5}, random.uniform(0.2, 1.0))));
    }
    for (int i = 0; i < 6; ++i)
      bodies.push_back({i % 2 == 0 ? Shape(circle(random)) : Shape(box(random)), random.uniform(0, 0.4),
                        random.uniform(0.4, 1)});
  }

  void add(const char* name, const Shape& shape, double bottom, double top) {
    world.obstacles.push_back({name, shape, top, bottom});
  }
  static Vec2 place(orca::RandomStream& random) { return {random.uniform(1, 11), random.uniform(1, 11)}; }
  static Box box(orca::RandomStream& random) {
    const Vec2 p = place(random);
    // Some are parallel to the axes, and some are thin as sheets.
    const double yaw = random.chance(0.3) ? 0.0 : random.uniform(-kPi, kPi);
    return {{p.x, p.y, yaw},
            {random.uniform(0.05, 0.8), random.chance(0.2) ? 0.001 : random.uniform(0.05, 0.8)}};
  }
  static Circle circle(orca::RandomStream& random) { return {place(random), random.uniform(0.02, 0.6)}; }
  static Outline polygon(orca::RandomStream& random) {
    const Vec2 center = place(random);
    std::vector<Vec2> corners;
    for (int k = 0; k < 5; ++k)
      corners.push_back(center + random.uniform(0.2, 0.9) * direction(2.0 * kPi * k / 5.0));
    return outline_of(corners);
  }

  [[nodiscard]] double reference(const Ray& ray, double growth) const {
    Reference reference(ray, growth);
    for (const Obstacle& o : world.obstacles) {
      if (o.mesh == nullptr) {
        reference.see(o.shape, o.bottom, o.height);
      } else {
        for (const Triangle& t : o.mesh->triangles) reference.see(t);
      }
    }
    for (const Body& b : bodies) reference.see(b.shape, b.bottom, b.top);
    return reference.range();
  }

  WorldModel world;
  std::vector<Body> bodies;
};

// The targets of the rays: corners, and sides along which rays run.
struct Targets {
  Targets(const Scene& scene, double height) {
    const auto take = [&](const Shape& shape) {
      for (const Segment& s : edges_of(shape)) sides.push_back(s);
      if (const auto* c = std::get_if<Circle>(&shape)) circles.push_back(*c);
    };
    for (const Obstacle& o : scene.world.obstacles) {
      if (o.mesh == nullptr) {
        take(o.shape);
      } else {
        for (const Triangle& t : o.mesh->triangles) take_corners(t, height);
      }
    }
    for (const Body& b : scene.bodies) take(b.shape);
    for (const Segment& s : sides) corners.push_back(s.a);
  }
  // Adds the points where the triangle's sides cross the plane at that height.
  void take_corners(const Triangle& t, double height) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = t[i];
      const Vec3& b = t[(i + 1) % 3];
      const double s = (height - a.z) / (b.z - a.z);
      if (s > 0.0 && s < 1.0) corners.push_back({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)});
    }
  }
  template <class List>
  static const auto& one_of(const List& list, orca::RandomStream& random) {
    return list[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(list.size()) - 1e-9))];
  }

  [[nodiscard]] Ray ray(orca::RandomStream& random, double height) const {
    Ray ray{{random.uniform(0.01, kSide - 0.01), random.uniform(0.01, kSide - 0.01)},
            direction(random.uniform(-kPi, kPi)),
            random.chance(0.5) ? 100.0 : random.uniform(0.0, 8.0),
            height};
    const double kind = random.uniform(0.0, 1.0);
    if (kind < 0.2) aim(ray, one_of(corners, random));
    if (kind >= 0.2 && kind < 0.3) run_along(ray, one_of(sides, random), random);
    if (kind >= 0.3 && kind < 0.35) pass(ray, one_of(circles, random));
    return ray;
  }
  static void aim(Ray& ray, Vec2 point) {
    const Vec2 w = point - ray.origin;
    if (norm(w) > 0.0) ray.direction = 1.0 / norm(w) * w;
  }
  static void run_along(Ray& ray, const Segment& side, orca::RandomStream& random) {
    const Vec2 u = 1.0 / norm(side.b - side.a) * (side.b - side.a);
    ray.origin = side.a - random.uniform(0.001, 3.0) * u;
    ray.direction = u;
  }
  static void pass(Ray& ray, const Circle& circle) {
    const Vec2 w = circle.center - ray.origin;
    if (norm(w) > circle.radius)
      ray.direction = rotated(1.0 / norm(w) * w, std::asin(circle.radius / norm(w)));
  }

  std::vector<Vec2> corners;
  std::vector<Segment> sides;
  std::vector<Circle> circles;
};

struct Tally {
  long rays = 0;
  long grazing = 0;    // Within the answers for a corner that is just met and one that is just missed.
  long wrong = 0;      // All others whose error is too large.
  long escaped = 0;    // Out of the closed room.
  double worst = 0.0;  // [m] Largest error, except for the grazing rays.
};

void judge(const Scene& scene, const Caster& caster, const Ray& ray, Tally& tally) {
  ++tally.rays;
  const Hit hit = caster.cast(ray);
  const Vec2 end = hit.point;
  const bool inside =
      ray.origin.x > 0.0 && ray.origin.y > 0.0 && ray.origin.x < kSide && ray.origin.y < kSide;
  const double farthest = std::max(std::fabs(end.x - 0.5 * kSide), std::fabs(end.y - 0.5 * kSide));
  if (inside && farthest > 0.5 * kSide + kGrazing) ++tally.escaped;
  const double error = std::fabs(hit.range - scene.reference(ray, 0.0));
  if (error > kSure) {
    const double met = scene.reference(ray, kGrazing);
    const double missed = scene.reference(ray, -kGrazing);
    const bool between =
        hit.range >= std::min(met, missed) - kSure && hit.range <= std::max(met, missed) + kSure;
    if (between && std::fabs(met - missed) > kSure) {
      ++tally.grazing;
      return;
    }
  }
  tally.worst = std::max(tally.worst, error);
  if (error > kExact) ++tally.wrong;
}

Tally cast_rays(long count) {
  constexpr long kPerScene = 10'000;
  orca::RandomStream random(21, "test", "rays");
  Tally tally;
  while (tally.rays < count) {
    const Scene scene(random);
    Caster caster(scene.world);
    for (const Body& b : scene.bodies) {
      const auto number = caster.add_body({Circle{{5.0, 5.0}, 1.0}, b.bottom, b.top});
      caster.move_body(number, b.shape);
    }
    caster.remove_body(caster.add_body({Circle{{6.0, 6.0}, 2.0}, 0.0, 1.0}));
    const double height = random.uniform(0.05, 0.95);
    const Targets targets(scene, height);
    for (long i = 0; i < kPerScene; ++i) judge(scene, caster, targets.ray(random, height), tally);
  }
  return tally;
}

void check(const Tally& tally) {
  std::cout << tally.rays << " rays, " << tally.grazing
            << " of them past a corner by less than 10 nm; the others are right within " << tally.worst
            << " m\n";
  CHECK(tally.wrong == 0);
  CHECK(tally.escaped == 0);
  CHECK(tally.worst <= kExact);
  CHECK(tally.grazing < tally.rays / 5);
}

}  // namespace

TEST_CASE("300,000 rays are within 1 mm of the closed form, and none leaves a closed room", "[sim][rays]") {
  check(cast_rays(300'000));
}

TEST_CASE("10,000,000 rays are within 1 mm of the closed form, and none leaves a closed room", "[.][slow]") {
  check(cast_rays(10'000'000));
}
