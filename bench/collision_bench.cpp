// SPDX-License-Identifier: GPL-3.0-or-later
// A motion of a robot's body past the echoes of two scans: the dearest part of a lap of orca.CollisionMonitor, which may add a
// millisecond.
#include <array>
#include <vector>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "orca/collision/swept_body.hpp"

namespace orca::bench {
namespace {

using collision::Post;
using collision::Solid;
using collision::SweptBody;

std::vector<Vec2> box(double x, double y, double length, double width) {
  const double a = 0.5 * length, b = 0.5 * width;
  return {{x - a, y - b}, {x + a, y - b}, {x + a, y + b}, {x - a, y + b}};
}

// A Pioneer 2-DX with its laser.
SweptBody pioneer() {
  return SweptBody(std::array{Solid{box(-0.0445, 0.0, 0.511, 0.14), 0.0, 0.07, 0.22},
                              Solid{box(-0.0445, 0.0, 0.463, 0.2), 0.0, 0.07, 0.22},
                              Solid{box(-0.0445, 0.0, 0.375, 0.306), 0.0, 0.07, 0.22},
                              Solid{box(0.0, 0.0, 0.165, 0.425), 0.0, 0.0, 0.165},
                              Solid{box(0.017, 0.008, 0.156, 0.155), 0.0, 0.22, 0.43}});
}

// The walls of a corridor, an echo every 2 cm.
std::vector<Post> corridor(double half_width) {
  std::vector<Post> posts;
  for (int i = 0; i < 190; ++i)
    for (const double side : {-half_width, half_width}) posts.push_back({{-1.0 + 0.02 * i, side}});
  return posts;
}

void add(const char* name, double half_width, double turn) {
  add_row({name, "", median_at_most(1e6)}, 200, [=](auto& state, Row& row) {
    const SweptBody body = pioneer();
    const std::vector<Post> posts = corridor(half_width);
    measure(state, row, 4, [&](int n) {
      return time_per_operation(n, [&] {
        for (int i = 0; i < n; ++i) benchmark::DoNotOptimize(body.along({0.5, 0.0, turn}, posts, 0.03));
      });
    });
  });
}

}  // namespace

void register_collision() {
  add("body along 0.5 m of a corridor of 1 m", 0.5, 0.0);
  add("body along 0.5 m of a corridor of 0.6 m", 0.3, 0.0);
  add("body in a bend towards a wall 0.3 m beside it", 0.3, 0.5);
}

}  // namespace orca::bench
