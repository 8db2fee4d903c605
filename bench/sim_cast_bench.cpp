// SPDX-License-Identifier: GPL-3.0-or-later
// Time of the rays of a laser fan in the scene of 200 turned boxes, compared with Bullet's own rays against
// one triangle mesh. A thousand divided by the nanoseconds per ray is millions of rays per second.
#include <vector>

#include "bare_bullet.hpp"
#include "benchmarks.hpp"
#include "comparison.hpp"
#include "orca/base/random.hpp"
#include "sim_scenes.hpp"

namespace orca::bench {
namespace {

constexpr Nanoseconds kSixMillionPerSecond = 1e3 / 6.0;
constexpr int kFans = 20;  // Per sample, which takes a few milliseconds at most.

/// A scene, and the poses from which rays are cast, in turn.
struct Views {
  Views() {
    RandomStream random(2, "bench", "views");
    while (poses.size() < 1000) {
      const Pose2 X_WS{random.uniform(0.5, 29.5), random.uniform(0.5, 19.5),
                       random.uniform(-std::numbers::pi, std::numbers::pi)};
      if (model.obstacle_at(sim::Circle{X_WS.position(), 0.2}, 0.0) == nullptr) poses.push_back(X_WS);
    }
  }
  const Pose2& next() { return poses[turn++ % poses.size()]; }

  sim::WorldModel model = two_hundred_boxes();
  std::vector<Pose2> poses;
  std::size_t turn = 0;
};

Nanoseconds orca_rays(Views& views, const Fan& fan, const sim::Caster& caster) {
  return time_per_operation(kFans * static_cast<int>(Fan::kBeams), [&] {
    for (int i = 0; i < kFans; ++i) benchmark::DoNotOptimize(fan.cast(caster, views.next()));
  });
}

Nanoseconds bullet_rays(Views& views, const Fan& fan, const BulletMesh& bullet) {
  return time_per_operation(kFans * static_cast<int>(Fan::kBeams), [&] {
    for (int i = 0; i < kFans; ++i) {
      const Pose2& X_WS = views.next();
      for (std::size_t k = 0; k < Fan::kBeams; ++k) benchmark::DoNotOptimize(bullet.cast(fan.ray(k, X_WS)));
    }
  });
}

void add_in_boxes(const char* name, const Row::Target& target) {
  add_row({name, "Bullet's own mesh rays", target}, 200, [](auto& state, Row& row) {
    Views views;
    const Fan fan;
    const sim::Caster caster(views.model);
    const BulletMesh bullet(views.model);
    alternate(
        state, row, 1, [&](int) { return orca_rays(views, fan, caster); },
        [&](int) { return bullet_rays(views, fan, bullet); });
  });
}

// Compares with a hundred robots: moving bodies must not cost much more than obstacles.
void add_among_robots() {
  add_row({"ray among 200 boxes and 100 robots", "without the robots"}, 200, [](auto& state, Row& row) {
    Views views;
    const Fan fan;
    const sim::Caster alone(views.model);
    sim::Caster crowded(views.model);
    for (int i = 0; i < 100; ++i) crowded.add_body({sim::Circle{views.next().position(), 0.205}, 0.05, 0.35});
    alternate(
        state, row, 1, [&](int) { return orca_rays(views, fan, crowded); },
        [&](int) { return orca_rays(views, fan, alone); });
  });
}

}  // namespace

void register_sim_cast() {
  add_in_boxes("ray among 200 boxes, 6 million a second", median_at_most(kSixMillionPerSecond));
  add_in_boxes("ray among 200 boxes, ten times Bullet's", ratio_at_most(0.1));
  add_among_robots();
}

}  // namespace orca::bench
