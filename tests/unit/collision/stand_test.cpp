// SPDX-License-Identifier: GPL-3.0-or-later
// FCL as a second opinion on where robots can stand: the simulator refuses a start at which two bodies share a point, and a driver reads
// the same body from the robot's file.
#include <catch2/catch.hpp>
#include <filesystem>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/collision/swept_body.hpp"
#include "orca/robot_file/figures.hpp"
#include "orca/sim/robot_file.hpp"
#include "orca/sim/world_file.hpp"

using namespace orca;
using namespace orca::collision;

namespace {

constexpr double kSpacing = 0.01;  // [m] of the posts along an outline

// Posts along the outline of an obstacle and in its middle, each from its underside to its top.
void add_posts(const sim::Obstacle& obstacle, std::vector<Post>& posts) {
  const auto add = [&](Vec2 place) { posts.push_back({place, obstacle.bottom, obstacle.height}); };
  const auto [low, high] = sim::bounds_of(obstacle.shape);
  add(0.5 * (low + high));
  if (const auto* circle = std::get_if<sim::Circle>(&obstacle.shape)) {
    const int count = static_cast<int>(7.0 * circle->radius / kSpacing) + 8;
    for (int i = 0; i < count; ++i)
      add(circle->center + circle->radius * direction(2.0 * std::numbers::pi * i / count));
  }
  for (const sim::Segment& edge : sim::edges_of(obstacle.shape)) {
    const Vec2 way = edge.b - edge.a;
    const int count = static_cast<int>(norm(way) / kSpacing) + 1;
    for (int i = 0; i <= count; ++i) add(edge.a + (1.0 * i / count) * way);
  }
}

// Returns the robot's body as a driver reads it.
SweptBody body_of(const std::string& file) {
  xml::Diagnostics wrong;
  const auto figures = robot_file::read_figures(file, wrong);
  REQUIRE(figures);
  std::vector<Solid> solids;
  for (const robot_file::BodyPart& part : figures->parts)
    solids.push_back({part.corners, part.radius, part.bottom, part.top});
  return SweptBody(solids);
}

double distance_at(const SweptBody& body, const Pose2& X_WB, const std::vector<Post>& posts) {
  double least = Approach::kFar;
  for (const Post& post : posts) {
    const Post seen{seen_from(X_WB, post.place), post.bottom, post.top};
    if (norm(seen.place) < body.reach() + Approach::kFar) least = std::min(least, body.distance(seen));
  }
  return least;
}

}  // namespace

TEST_CASE(
    "where the simulator lets a robot stand, FCL finds its body clear of everything, and elsewhere it finds "
    "what is there",
    "[collision][sim]") {
  xml::Diagnostics wrong;
  const auto world = sim::read_world(ORCA_SOURCE_DIR "/sim/worlds/office.xml", {}, wrong);
  REQUIRE(world);
  std::vector<Post> posts;
  for (const sim::Obstacle& obstacle : world->obstacles) add_posts(obstacle, posts);
  const auto [low, high] = world->bounds();
  RandomStream random(1, "test", "poses");
  int free = 0, taken = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ORCA_SOURCE_DIR "/sim/robots")) {
    if (entry.path().extension() != ".urdf") continue;
    const std::string file = entry.path();
    const auto model = sim::read_robot(file, wrong);
    REQUIRE(model);
    const SweptBody body = body_of(file);
    for (int i = 0; i < 100; ++i) {
      const Pose2 pose{random.uniform(low.x, high.x), random.uniform(low.y, high.y),
                       random.uniform(-3.1, 3.1)};
      const sim::Obstacle* const there =
          world->obstacle_at(sim::placed(model->footprint, pose), model->bottom, model->top);
      const double distance = distance_at(body, pose, posts);
      CAPTURE(file, pose.x, pose.y, pose.yaw, distance, there != nullptr ? there->name : "nothing");
      ++(there != nullptr ? taken : free);
      if (there == nullptr) CHECK(distance > 0.0);
      // The simulator looks at the hull of all parts, FCL at each of them.
      if (distance <= -kSpacing) CHECK(there != nullptr);
      if (there != nullptr) CHECK(distance < Approach::kFar);
    }
  }
  CHECK(free > 100);
  CHECK(taken > 100);
}
