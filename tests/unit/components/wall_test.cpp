// SPDX-License-Identifier: GPL-3.0-or-later
// The directions in which FollowWall drives.
#include "follow_wall/wall.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "orca/geometry/pose2.hpp"

using namespace orca;
using namespace orca::wall;

namespace {

constexpr Limits kLimits{.side = Side::left, .radius = 0.2, .distance = 0.4, .least = 0.1, .max_speed = 0.3};
constexpr double kFine = 0.02;  // [rad]

// A wall of posts, each 5 cm from the next.
void add_wall(Vec2 from, Vec2 to, std::vector<Vec2>& posts) {
  const int steps = static_cast<int>(norm(to - from) / 0.05);
  for (int i = 0; i <= steps; ++i) posts.push_back(from + (1.0 * i / steps) * (to - from));
}

// Drives a point robot that sees all, for a time [s]; calls look(pose) in each step.
template <class Look>
Pose2 drive(Pose2 pose, const std::vector<Vec2>& posts, double time, Look look) {
  constexpr double kLap = 0.05;
  for (double t = 0.0; t < time; t += kLap) {
    std::vector<Vec2> echoes;
    for (const Vec2 post : posts) echoes.push_back(seen_from(pose, post));
    const Step step = step_along(echoes, kLimits);
    pose.yaw = wrapped(pose.yaw + std::clamp(2.0 * step.direction, -1.0, 1.0) * kLap);
    pose = pose * Pose2{step.speed * kLap, 0.0, 0.0};
    look(pose);
  }
  return pose;
}

double nearest(const Pose2& pose, const std::vector<Vec2>& posts) {
  double least = 1e9;
  for (const Vec2 post : posts) least = std::min(least, norm(post - pose.position()));
  return least;
}

}  // namespace

TEST_CASE("without a wall a robot drives straight on", "[wall]") {
  const Step step = step_along({}, kLimits);
  CHECK_FALSE(step.follows);
  CHECK(step.direction == 0.0);
  CHECK(step.speed == kLimits.max_speed);
}

TEST_CASE("beside a straight wall a robot keeps its distance, and closes an error by its share of a step",
          "[wall]") {
  for (const double off : {-0.2, -0.1, 0.0, 0.1, 0.2, 0.3}) {
    const std::vector<Vec2> wall{{0.0, 0.6 + off}};
    const Step step = step_along(wall, kLimits);
    CAPTURE(off);
    CHECK(step.follows);
    CHECK(step.direction == Approx(std::asin(off / kStep)).margin(kFine));
  }
}

TEST_CASE("a wall on the right is followed as its mirror image", "[wall]") {
  Limits right = kLimits;
  right.side = Side::right;
  const std::vector<Vec2> one{{0.1, 0.8}, {0.9, 0.1}};
  const std::vector<Vec2> mirrored{{0.1, -0.8}, {0.9, -0.1}};
  CHECK(step_along(mirrored, right).direction == Approx(-step_along(one, kLimits).direction));
}

TEST_CASE("a robot goes round a room and the block in it, at its distance, past a door", "[wall]") {
  std::vector<Vec2> posts;
  add_wall({0.0, 0.0}, {3.0, 0.0}, posts);
  add_wall({3.0, 0.0}, {3.0, 1.5}, posts);  // a block of 1 m
  add_wall({3.0, 1.5}, {4.0, 1.5}, posts);
  add_wall({4.0, 1.5}, {4.0, 0.0}, posts);
  add_wall({4.0, 0.0}, {7.0, 0.0}, posts);
  add_wall({7.0, 0.0}, {7.0, 5.0}, posts);
  add_wall({7.0, 5.0}, {4.0, 5.0}, posts);  // a door of 0.9 m
  add_wall({3.1, 5.0}, {0.0, 5.0}, posts);
  add_wall({0.0, 5.0}, {0.0, 0.0}, posts);
  int corners = 0;
  bool was_in_corner = false;
  double least = 1e9;
  double most = 0.0;
  drive({1.0, 4.3, 0.0}, posts, 100.0, [&](const Pose2& pose) {
    least = std::min(least, nearest(pose, posts));
    most = std::max(most, nearest(pose, posts));
    const bool in_corner = pose.x > 5.8 && pose.y < 1.2;
    corners += in_corner && !was_in_corner ? 1 : 0;
    was_in_corner = in_corner;
  });
  CHECK(least > 0.5);
  CHECK(most < 0.8);
  CHECK(corners >= 1);
}

TEST_CASE("a robot turns away on the spot where nothing leaves it room", "[wall]") {
  std::vector<Vec2> pocket;
  add_wall({-0.25, 0.25}, {0.25, 0.25}, pocket);
  add_wall({0.25, 0.25}, {0.25, -0.25}, pocket);
  add_wall({0.25, -0.25}, {-0.25, -0.25}, pocket);
  const Step step = step_along(pocket, kLimits);
  CHECK(step.speed == 0.0);
  CHECK(step.direction < 0.0);
}
