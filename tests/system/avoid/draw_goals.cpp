// SPDX-License-Identifier: GPL-3.0-or-later
// Draws starts and goals for the avoid sweep: draw_goals WORLD MAP_WIDTH COUNT SEED
//
// Prints a line for each: start x y heading, goal x y, and "clear" if a disc of the required clearance can
// move straight from one to the other, else "blocked".
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "orca/base/random.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/world_file.hpp"

namespace {

using namespace orca::sim;
using orca::direction;
using orca::Vec2;

constexpr double kClearance = 0.35;  // [m] free around a start and a goal
constexpr double kNearest = 4.0;     // [m] from start to goal
constexpr double kFarthest = 15.0;
constexpr double kIndoors = 60.0;  // [m] indoors there is a wall within this distance on every side

class Storey {
 public:
  explicit Storey(WorldModel world) : world_(std::move(world)), caster_(world_), bounds_(world_.bounds()) {}

  [[nodiscard]] bool free(Vec2 p) const {
    return world_.obstacle_at(Circle{p, kClearance}, 0.0) == nullptr && indoors(p);
  }

  [[nodiscard]] Vec2 free_place(orca::RandomStream& random) const {
    while (true) {
      const double x = random.uniform(bounds_.low.x, bounds_.high.x);
      const Vec2 p{x, random.uniform(bounds_.low.y, bounds_.high.y)};
      if (free(p)) return p;
    }
  }

  [[nodiscard]] bool clear(Vec2 from, Vec2 to) const {
    const int steps = static_cast<int>(norm(to - from) / 0.05) + 1;
    for (int i = 0; i <= steps; ++i)
      if (!free(from + (static_cast<double>(i) / steps) * (to - from))) return false;
    return true;
  }

 private:
  // Storey plans have free space and lettering around the building, which do not count.
  [[nodiscard]] bool indoors(Vec2 p) const {
    constexpr int kRays = 16;
    for (int i = 0; i < kRays; ++i) {
      const Ray ray{p, direction(2.0 * std::numbers::pi * i / kRays), kIndoors, 0.0};
      if (!caster_.cast(ray).found()) return false;
    }
    return true;
  }

  WorldModel world_;
  Caster caster_;
  Bounds bounds_;
};

void draw(const Storey& floor, int count, std::uint64_t seed) {
  orca::RandomStream random(seed, "draw_goals", "places");
  for (int drawn = 0; drawn < count;) {
    const Vec2 start = floor.free_place(random);
    const Vec2 goal = floor.free_place(random);
    const double heading = random.uniform(-std::numbers::pi, std::numbers::pi);
    const double distance = norm(goal - start);
    if (distance < kNearest || distance > kFarthest) continue;
    std::printf("%.3f %.3f %.3f %.3f %.3f %s\n", start.x, start.y, heading, goal.x, goal.y,
                floor.clear(start, goal) ? "clear" : "blocked");
    ++drawn;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: draw_goals WORLD MAP_WIDTH COUNT SEED   (MAP_WIDTH 0 for a world in XML)\n", stderr);
    return 2;
  }
  const double width = std::strtod(argv[2], nullptr);
  orca::xml::Diagnostics diagnostics;
  const BitmapScale scale{width > 0.0 ? std::optional(width) : std::nullopt, {}};
  auto world = read_world(argv[1], scale, diagnostics);
  if (!world) {
    std::fputs(diagnostics.text().c_str(), stderr);
    return 2;
  }
  draw(Storey(std::move(*world)), std::atoi(argv[3]), std::strtoull(argv[4], nullptr, 10));
  return 0;
}
