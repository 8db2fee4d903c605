// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim_scenes.hpp"

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <numeric>

#include "orca/base/random.hpp"
#include "orca/sim/bitmap.hpp"

namespace orca::bench {
namespace {

using namespace sim;

constexpr double kDegree = std::numbers::pi / 180.0;

std::filesystem::path data_folder() {
  const char* const given = std::getenv("ORCA_DATA");
  return given != nullptr ? given : "../shared/data";
}

SonarRing sonar_ring() {
  SonarRing ring;
  ring.name = "sonar";
  ring.count = 16;
  ring.pitch = 22.5 * kDegree;
  ring.half_lobe = 12.5 * kDegree;
  ring.min_range = 0.15;
  ring.max_range = 6.5;
  ring.quantum = 0.0254;
  ring.radius = 0.19;
  ring.period = std::chrono::milliseconds{100};
  ring.height = 0.3;
  ring.order.resize(ring.count);
  std::iota(ring.order.begin(), ring.order.end(), std::size_t{0});
  return ring;
}

}  // namespace

WorldModel two_hundred_boxes() {
  RandomStream random(1, "bench", "boxes");
  WorldModel world{"boxes", {}, {}};
  world.obstacles.push_back({"south", Box{{15, 0, 0}, {15, 0.1}}, 2.5});
  world.obstacles.push_back({"north", Box{{15, 20, 0}, {15, 0.1}}, 2.5});
  world.obstacles.push_back({"west", Box{{0, 10, 0}, {0.1, 10}}, 2.5});
  world.obstacles.push_back({"east", Box{{30, 10, 0}, {0.1, 10}}, 2.5});
  for (int i = 0; i < 200; ++i) {
    const Pose2 pose{random.uniform(1, 29), random.uniform(1, 19),
                     random.uniform(-std::numbers::pi, std::numbers::pi)};
    world.obstacles.push_back({"box", Box{pose, {random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)}}, 1.0});
  }
  return world;
}

std::optional<WorldModel> cave() {
  const std::filesystem::path file = data_folder() / "stage_maps" / "cave.png";
  Result<WorldModel> world = read_bitmap_world(file.string(), {.map_width = 16.0, .resolution = {}});
  if (world) return std::move(*world);
  std::cerr << "bench: the cave is left out, because its picture cannot be read: " << world.error().text()
            << "; set ORCA_DATA to the folder that holds stage_maps\n";
  return std::nullopt;
}

RobotModel scout() {
  RobotModel m;
  m.name = "scout";
  m.radius = 0.19;
  m.bumper_radius = 0.205;
  m.mass = 23.0;
  m.yaw_inertia = 0.45;
  m.parts = {{Part::Cylinder{0.205, 0.3}, {.x = 0.0, .y = 0.0, .z = 0.2}}};
  m.footprint = footprint_of(m.parts);
  std::tie(m.bottom, m.top) = height_range_of(m.parts);
  m.drive.max_speed = 1.0;
  m.drive.max_turn_rate = 2.0;
  m.drive.max_acceleration = 0.76;
  m.drive.max_turn_acceleration = 4.0;
  m.drive.track = 0.3452;
  m.drive.wheel_diameter = 0.15;
  m.drive.lag = std::chrono::milliseconds{100};
  m.drive.dead_time = std::chrono::milliseconds{50};
  m.sonars = {sonar_ring()};
  m.odometer = Odometer{std::chrono::milliseconds{100}};
  return m;
}

// The number of adjacent beams that share one view.
constexpr std::size_t kTogether = 19;
static_assert(Fan::kBeams % kTogether == 0);

Fan::Fan() {
  for (std::size_t k = 0; k < kBeams; ++k)
    directions_[k] = direction((0.5 * static_cast<double>(k) - 90.0) * kDegree);
}

Ray Fan::ray(std::size_t beam, const Pose2& X_WS) const {
  return {X_WS.position(), rotated(directions_[beam], X_WS.yaw), kRange, kHeight};
}

std::array<double, Fan::kBeams> Fan::cast(const Caster& caster, const Pose2& X_WS,
                                          std::size_t own_body) const {
  std::array<double, kBeams> ranges;
  const Vec2 ahead = direction(X_WS.yaw);
  const auto ray = [&](std::size_t k) {
    return Ray{X_WS.position(), rotated(directions_[k], ahead), kRange, kHeight, own_body};
  };
  for (std::size_t first = 0; first < kBeams; first += kTogether) {
    const Caster::View view(caster, ray(first + kTogether / 2), 0.25 * kTogether * kDegree);
    for (std::size_t k = first; k < first + kTogether; ++k) ranges[k] = view.cast(ray(k)).range;
  }
  return ranges;
}

}  // namespace orca::bench
