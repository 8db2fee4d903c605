// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/sim/caster.hpp"
#include "upright_face.hpp"

namespace orca::sim::test {

/// Something that stands about, in the tests' own terms: a round thing or one with corners.
struct Furniture {
  Vec2 middle;
  double reach = 0.0;         ///< [m] Nothing of it is farther from its middle.
  double radius = -1.0;       ///< [m] Negative: it has corners.
  std::vector<Vec2> corners;  ///< Counter-clockwise, in the world frame.
  double bottom = 0.0;        ///< [m]
  double top = 2.5;           ///< [m]

  /// Returns true if the point lies inside, at a height.
  [[nodiscard]] bool holds(Vec2 p, double height) const {
    if (bottom > height || top <= height) return false;
    if (radius >= 0.0) return norm(p - middle) < radius;
    bool inside = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i] - p;
      const Vec2 b = corners[(i + 1) % corners.size()] - p;
      if ((a.y > 0.0) != (b.y > 0.0) && a.x - a.y * (b.x - a.x) / (b.y - a.y) > 0.0) inside = !inside;
    }
    return inside;
  }
  [[nodiscard]] Shape shape() const {
    return radius >= 0.0 ? Shape{Circle{middle, radius}} : Shape{outline_of(corners)};
  }
};

/// A square of 14 m with legs, posts, boards, corners, walls in line, parts of bitmaps, kerbs and table tops at random
/// places. They may stand in each other.
class FurnishedRoom {
 public:
  static constexpr double kSide = 14.0;  // [m]

  explicit FurnishedRoom(RandomStream& random) : random_(random) {
    for (int i = 0; i < 14; ++i) add_round(0.01, 0.0, 0.75);  // Chair legs.
    for (int i = 0; i < 10; ++i) add_round(0.075, 0.0, 1.0);  // Posts.
    for (int i = 0; i < 4; ++i) add_round(uniform(0.2, 0.6), 0.0, 1.0);
    for (int i = 0; i < 8; ++i) add_box({uniform(0.01, 0.03), uniform(0.1, 1.5)}, 0.0, 2.5);  // Boards.
    for (int i = 0; i < 4; ++i) add_box({uniform(0.2, 0.8), uniform(0.2, 0.8)}, 0.0, 2.5);
    for (int i = 0; i < 3; ++i)
      add_box({uniform(0.05, 0.3), uniform(0.3, 2.0)}, 0.0, uniform(0.05, 0.28));  // Kerbs.
    for (int i = 0; i < 2; ++i) add_box({0.4, uniform(0.4, 1.0)}, uniform(0.32, 0.9), uniform(0.92, 1.1));
    add_round(0.55, 0.7, 0.74);
    for (int i = 0; i < 3; ++i) add_corner();
    for (int i = 0; i < 3; ++i) add_walls_in_line();
    for (int i = 0; i < 3; ++i) add_cells();
  }

  /// Half of the things are obstacles, half are solids of bodies, which the caster keeps apart: the first of bodies of
  /// three solids, the others of bodies of one.
  [[nodiscard]] Caster caster() const {
    WorldModel world;
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < things_.size(); ++i) {
      const Furniture& thing = things_[i];
      if (i % 2 == 0) {
        world.obstacles.push_back({"thing", thing.shape(), thing.top, thing.bottom});
      } else {
        bodies.push_back({thing.shape(), thing.bottom, thing.top});
      }
    }
    Caster caster(world);
    std::size_t i = 0;
    for (; i + 3 < bodies.size() / 2; i += 3) caster.add_solids({bodies[i], bodies[i + 1], bodies[i + 2]});
    for (; i < bodies.size(); ++i) caster.add_body(bodies[i]);
    return caster;
  }

  /// Returns a pose outside all things at a height. Most poses have a random thing within the lobe and range.
  [[nodiscard]] Pose2 pose(double half_lobe, double range, double height) {
    for (;;) {
      const Pose2 pose = any_pose(half_lobe, range);
      if (std::ranges::none_of(things_, [&](const Furniture& f) { return f.holds(pose.position(), height); }))
        return pose;
    }
  }

  /// Returns the faces that may lie within the range, seen from a sensor at a height [m].
  [[nodiscard]] std::vector<UprightFace> faces_from(const Pose2& sensor, double range, double height) const {
    std::vector<UprightFace> faces;
    const auto local = [&](Vec2 p) {
      const Vec2 w = p - sensor.position();
      const Vec2 axis = direction(sensor.yaw);
      return Vec2{dot(axis, w), cross(axis, w)};
    };
    for (const Furniture& thing : things_) {
      if (norm(thing.middle - sensor.position()) > range + thing.reach) continue;
      const UprightFace face{
          local(thing.middle), {}, thing.radius, thing.bottom - height, thing.top - height};
      if (face.is_round()) faces.push_back(face);
      for (std::size_t i = 0; i < thing.corners.size(); ++i) {
        faces.push_back(face);
        faces.back().a = local(thing.corners[i]);
        faces.back().b = local(thing.corners[(i + 1) % thing.corners.size()]);
      }
    }
    return faces;
  }

 private:
  double uniform(double from, double to) { return random_.uniform(from, to); }
  Vec2 anywhere() { return {uniform(0, kSide), uniform(0, kSide)}; }

  Pose2 any_pose(double half_lobe, double range) {
    if (random_.chance(0.3)) return {uniform(0, kSide), uniform(0, kSide), uniform(-kPi, kPi)};
    const auto count = static_cast<double>(things_.size());
    const Furniture& aim = things_[static_cast<std::size_t>(uniform(0.0, count))];
    const double heading = uniform(-kPi, kPi);
    const Vec2 at = aim.middle - uniform(0.1, range) * direction(heading);
    return {at.x, at.y, heading + uniform(-half_lobe, half_lobe)};
  }

  void add_round(double radius, double bottom, double top) {
    things_.push_back({anywhere(), radius, radius, {}, bottom, top});
  }
  void add_box(Vec2 half, double bottom, double top) {
    add_box_at(anywhere(), uniform(-kPi, kPi), half, bottom, top);
  }
  void add_box_at(Vec2 middle, double yaw, Vec2 half, double bottom = 0.0, double top = 2.5) {
    add_corners(middle, yaw, {{-half.x, -half.y}, {half.x, -half.y}, half, {-half.x, half.y}}, bottom, top);
  }
  void add_corners(Vec2 middle, double yaw, std::vector<Vec2> corners, double bottom, double top) {
    Furniture thing{middle, 0.0, -1.0, {}, bottom, top};
    for (const Vec2 corner : corners) {
      thing.reach = std::max(thing.reach, norm(corner));
      thing.corners.push_back(middle + rotated(corner, yaw));
    }
    things_.push_back(std::move(thing));
  }
  // Two walls that meet at a right angle.
  void add_corner() {
    const Vec2 at = anywhere();
    const double yaw = uniform(-kPi, kPi);
    const double length = uniform(0.5, 2.0);
    for (const double heading : {yaw, yaw + 0.5 * kPi})
      add_box_at(at + length * direction(heading), heading, {length + 0.05, 0.05});
  }
  // Two walls in one line, which touch each other or overlap.
  void add_walls_in_line() {
    const Vec2 at = anywhere();
    const double yaw = uniform(-kPi, kPi);
    const double length = uniform(0.5, 1.5);
    const double more = random_.chance(0.5) ? 0.0 : 0.05;
    for (const double side : {-1.0, 1.0})
      add_box_at(at + side * length * direction(yaw), yaw, {length + more, 0.05});
  }
  // Columns of cells of 0.1 m, as a bitmap has them. Where two columns are equally high, edges go on in line.
  void add_cells() {
    constexpr double kCell = 0.1;
    constexpr int kColumns = 8;
    std::vector<Vec2> corners{{-0.5 * kColumns * kCell, 0.0}, {0.5 * kColumns * kCell, 0.0}};
    for (int i = kColumns; i > 0; --i) {
      const double height = kCell * std::floor(uniform(1.0, 5.0));
      for (const int column : {i, i - 1}) {
        const Vec2 corner{(column - 0.5 * kColumns) * kCell, height};
        if (!(corner == corners.back())) corners.push_back(corner);
      }
    }
    add_corners(anywhere(), random_.chance(0.5) ? 0.0 : uniform(-kPi, kPi), std::move(corners), 0.0, 2.5);
  }

  RandomStream& random_;
  std::vector<Furniture> things_;
};

}  // namespace orca::sim::test
