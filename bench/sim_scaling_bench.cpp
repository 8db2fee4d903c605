// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one simulated second of a robot, as in sim_world_bench.cpp, in worlds of different extent: it depends on what
// stands near the robot, and not on what stands elsewhere.
#include <optional>
#include <string>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "orca/base/random.hpp"
#include "sim_scenes.hpp"
#include "wanderers.hpp"

namespace orca::bench {
namespace {

constexpr double kAreaPerBox = 20.0;  // [m2] Ten boxes fill the range of the sensors, 6.5 to 8 m.
constexpr double kPark = 4.0;         // [m] Side of the square in which the robot starts.
constexpr double kMostOfScale = 2.0;
constexpr double kMostOfPost = 1.05;
constexpr int kSeconds = 20;   // Per sample.
constexpr int kSamples = 200;  // More than elsewhere: 5 % are to be told from noise.

/// Returns turned boxes in a walled square around the origin. The first ones are those nearest to it, and the same for any
/// count.
sim::WorldModel boxes(int count) {
  RandomStream random(4, "bench", "scaling");
  sim::WorldModel world{"boxes", {}, {}};
  double side = 0.0;
  for (int i = 0; i < count; ++i) {
    // A ring of the square, as wide as its boxes need at this density.
    const double inner = side;
    side = std::sqrt(kAreaPerBox * (i + 1));
    const double along = random.uniform(-0.5, 0.5) * side;
    const double out = 0.5 * random.uniform(inner, side);
    const int edge = i % 4;
    const Vec2 at = edge == 0   ? Vec2{along, out}
                    : edge == 1 ? Vec2{along, -out}
                    : edge == 2 ? Vec2{out, along}
                                : Vec2{-out, along};
    const sim::Box box{{at.x, at.y, random.uniform(-std::numbers::pi, std::numbers::pi)},
                       {random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)}};
    world.obstacles.push_back({"box", box, 1.0});
  }
  const double half = 0.5 * side;
  for (const double out : {-half, half}) {
    world.obstacles.push_back({"wall", sim::Box{{out, 0, 0}, {0.1, half}}, 2.5});
    world.obstacles.push_back({"wall", sim::Box{{0, out, 0}, {half, 0.1}}, 2.5});
  }
  return world;
}

sim::WorldModel with_far_post(sim::WorldModel world) {
  world.obstacles.push_back({"post", sim::Circle{{2000.0, -500.0}, 0.1}, 1.0});
  return world;
}

void add(const std::string& name, const std::string& reference, const sim::WorldModel& one,
         const sim::WorldModel& other, double limit) {
  const sim::Bounds park{{-0.5 * kPark, -0.5 * kPark}, {0.5 * kPark, 0.5 * kPark}};
  const auto area = [park](const sim::WorldModel& model) {
    return model.name == "boxes" ? park : model.bounds();
  };
  add_row({"a simulated second " + name, reference, ratio_at_most(limit)}, kSamples,
          [=](auto& state, Row& row) {
            Wanderers subject(one, {}, true, area(other));  // Both start where the smaller world has room.
            Wanderers compared(other, {}, true, area(other));
            alternate(
                state, row, kSeconds, [&](int n) { return seconds_of(subject, n); },
                [&](int n) { return seconds_of(compared, n); });
          });
}

void add_scale(int count, int reference) {
  add("among " + std::to_string(count) + " obstacles", "among " + std::to_string(reference), boxes(count),
      boxes(reference), kMostOfScale);
}

}  // namespace

void register_sim_scaling() {
  for (const int count : {1'000, 10'000, 100'000}) add_scale(count, 10);
  add_scale(10, 100'000);
  add("among 200 boxes and a far post", "without the post", with_far_post(two_hundred_boxes()),
      two_hundred_boxes(), kMostOfPost);
  if (const std::optional<sim::WorldModel> map = cave())
    add("in the cave with a far post", "without the post", with_far_post(*map), *map, kMostOfPost);
}

}  // namespace orca::bench
