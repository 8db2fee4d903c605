// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/stand.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "doors.hpp"
#include "orca/collision/rigid_body.hpp"
#include "orca/robot_file/figures.hpp"
#include "orca/sim/sections.hpp"
#include "orca/xml/number.hpp"

namespace orca::sim {
namespace {

using collision::Facet;
using collision::RigidBody;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kDirections = 32;      // In which a way out is looked for.
constexpr double kStrideOut = 0.05;  // [m]
constexpr double kFarOut = 5.0;      // [m]
constexpr double kExactOut = 0.001;  // [m]

Isometry3d in_space(const Pose2& X, double z = 0.0) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() << X.x, X.y, z;
  const Vec2 ahead = direction(X.yaw);
  pose.linear() << ahead.x, -ahead.y, 0.0, ahead.y, ahead.x, 0.0, 0.0, 0.0, 1.0;
  return pose;
}

Isometry3d in_space(const Pose3& X) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() << X.x, X.y, X.z;
  pose.linear() = Eigen::Quaterniond(X.qw, X.qx, X.qy, X.qz).toRotationMatrix();
  return pose;
}

void add(const Part& part, RigidBody& body) {
  const Isometry3d X_BP = in_space(part.X_BP);
  if (const auto* block = std::get_if<Part::Block>(&part.form)) {
    body.add_block(X_BP, {block->x, block->y, block->z});
  } else if (const auto* cylinder = std::get_if<Part::Cylinder>(&part.form)) {
    body.add_cylinder(X_BP, cylinder->radius, cylinder->length);
  } else if (const auto* ball = std::get_if<Part::Ball>(&part.form)) {
    body.add_ball(X_BP.translation(), ball->radius);
  } else {
    std::vector<Vector3d> corners;
    for (const Vec3& p : std::get<Part::Hull>(part.form).corners)
      corners.push_back(X_BP * Vector3d(p.x, p.y, p.z));
    body.add_hull(std::move(corners));
  }
}

// The room that something takes. A robot takes that of its parts and of the paddles of its gripper, open and down, as they are at first.
struct Stander {
  explicit Stander(const Item& item)
      : parts{{Part::Cylinder{item.radius, item.height}, {.z = 0.5 * item.height}}}, reach(item.radius) {}
  Stander(const RobotModel& robot, Extent extent) : parts(robot.parts) {
    for (const Segment& edge : edges_of(robot.footprint)) reach = std::max(reach, norm(edge.a));
    if (const auto* round = std::get_if<Circle>(&robot.footprint))
      reach = norm(round->center) + round->radius;
    if (!robot.gripper || extent == Extent::solid) return;
    for (const robot_file::BodyPart& paddle : robot_file::paddles_of(*robot.gripper, 0.0)) {
      std::vector<Vector3d>& corners = paddles.emplace_back();
      for (const Vec2 p : paddle.corners) {
        for (const double z : {paddle.bottom, paddle.top}) corners.emplace_back(p.x, p.y, z);
        reach = std::max(reach, norm(p));
      }
    }
  }

  // Asks FCL, so it is called only where something is near.
  [[nodiscard]] RigidBody body() const {
    RigidBody body;
    for (const Part& part : parts) add(part, body);
    for (const std::vector<Vector3d>& corners : paddles) body.add_hull(corners);
    return body;
  }

  std::vector<Part> parts;
  std::vector<std::vector<Vector3d>> paddles{};  // [m]
  double reach = 0.0;                            // [m] of the farthest point from the middle
};

// The area around a robot in which its surroundings count.
struct Area {
  Vec2 middle;
  double radius;  // [m]

  [[nodiscard]] bool has(Vec2 low, Vec2 high) const {
    const Vec2 nearest{std::clamp(middle.x, low.x, high.x), std::clamp(middle.y, low.y, high.y)};
    return norm(nearest - middle) <= radius;
  }
  [[nodiscard]] bool has(Vec2 place, double reach) const { return norm(place - middle) <= radius + reach; }
  [[nodiscard]] bool has(const Facet& f) const {
    const Vector3d low = f[0].cwiseMin(f[1]).cwiseMin(f[2]);
    const Vector3d high = f[0].cwiseMax(f[1]).cwiseMax(f[2]);
    return has({low.x(), low.y()}, {high.x(), high.y()});
  }
};

// What stands around under one name, in the world's frame.
struct Thing {
  std::string name;
  RigidBody body{};
  std::vector<const Obstacle*> hollow{};  // Those of which `body` has the surface only.
};

std::vector<Facet> facets_of(const Obstacle& obstacle) {
  std::vector<Facet> facets;
  if (obstacle.mesh != nullptr) {
    const auto point = [](const Vec3& p) { return Vector3d(p.x, p.y, p.z); };
    for (const Triangle& t : obstacle.mesh->triangles)
      facets.push_back({point(t[0]), point(t[1]), point(t[2])});
    return facets;
  }
  for (const auto& [a, b] : edges_of(obstacle.shape)) {
    const Vector3d foot_a(a.x, a.y, obstacle.bottom), foot_b(b.x, b.y, obstacle.bottom);
    const Vector3d head_a(a.x, a.y, obstacle.height), head_b(b.x, b.y, obstacle.height);
    facets.push_back({foot_a, foot_b, head_b});
    facets.push_back({foot_a, head_b, head_a});
  }
  return facets;
}

void add(const Obstacle& obstacle, const Area& area, Thing& thing) {
  const double middle = 0.5 * (obstacle.bottom + obstacle.height);
  const double height = obstacle.height - obstacle.bottom;
  const auto* const circle = std::get_if<Circle>(&obstacle.shape);
  const auto* const box = std::get_if<Box>(&obstacle.shape);
  if (obstacle.mesh == nullptr && circle != nullptr)
    return thing.body.add_cylinder(in_space({circle->center.x, circle->center.y, 0.0}, middle),
                                   circle->radius, height);
  if (obstacle.mesh == nullptr && box != nullptr)
    return thing.body.add_block(in_space(box->pose, middle), {2.0 * box->half.x, 2.0 * box->half.y, height});
  std::vector<Facet> facets = facets_of(obstacle);
  std::erase_if(facets, [&](const Facet& facet) { return !area.has(facet); });
  thing.body.add_surface(facets);
  thing.hollow.push_back(&obstacle);
}

Thing& named(const std::string& name, std::vector<Thing>& things) {
  const auto found = std::ranges::find(things, name, &Thing::name);
  return found != things.end() ? *found : things.emplace_back(Thing{name});
}

std::vector<Thing> obstacles_in(const Area& area, const WorldModel& world) {
  std::vector<Thing> things;
  for (const Obstacle& obstacle : world.obstacles) {
    const Bounds bounds = bounds_of(obstacle.shape);
    if (area.has(bounds.low, bounds.high)) add(obstacle, area, named(obstacle.name, things));
  }
  return things;
}

std::vector<Thing> things_in(const Area& area, const WorldModel& world, std::span<const Item> items) {
  std::vector<Thing> things = obstacles_in(area, world);
  for (const Door& door : world.doors) {
    const Pose2 X_WL = detail::pose_at(door, door.open ? 1.0 : 0.0);
    const double length = norm(door.shut.b - door.shut.a);
    if (!area.has(X_WL.position(), 0.5 * norm({length, door.thickness}))) continue;
    named(door.name, things)
        .body.add_block(in_space(X_WL, 0.5 * door.height), {length, door.thickness, door.height});
  }
  for (const Item& item : items)
    if (area.has(item.pose.position(), item.radius))
      named(item.name, things)
          .body.add_cylinder(in_space(item.pose, 0.5 * item.height), item.radius, item.height);
  return things;
}

// Returns whether a part is in the middle of an obstacle, beside whose sides nothing of it is.
bool is_within(const Part& part, const Pose2& X_WB, const Obstacle& obstacle) {
  const Vec2 middle = X_WB * Vec2{part.X_BP.x, part.X_BP.y};
  if (obstacle.mesh != nullptr) return contains(section_of(*obstacle.mesh, part.X_BP.z), middle);
  const std::vector<Shape> there = plans_between({part}, obstacle.bottom, obstacle.height);
  if (there.empty()) return false;
  const Bounds plan = bounds_of(placed(there.front(), X_WB));
  return contains(obstacle.shape, 0.5 * (plan.low + plan.high));
}

bool meets(const Stander& stander, const RigidBody& body, const Pose2& X_WB, const Thing& thing) {
  if (body.meets(thing.body, in_space(X_WB).inverse())) return true;
  return std::ranges::any_of(thing.hollow, [&](const Obstacle* obstacle) {
    return std::ranges::any_of(stander.parts,
                               [&](const Part& part) { return is_within(part, X_WB, *obstacle); });
  });
}

// Returns how a robot that stands in something comes out of it, moved sideways without a turn.
// @param is_in  whether it stands in it at a pose.
StandsIn way_out(std::string name, const Pose2& X_WB, const std::function<bool(const Pose2&)>& is_in) {
  StandsIn found{.name = std::move(name), .way = kFarOut};
  for (int k = 0; k < kDirections; ++k) {
    const Vec2 way = direction(2.0 * std::numbers::pi * k / kDirections);
    const auto at = [&](double out) { return Pose2{X_WB.x + out * way.x, X_WB.y + out * way.y, X_WB.yaw}; };
    double out = kStrideOut;
    while (out < found.way && is_in(at(out))) out += kStrideOut;
    double in = out - kStrideOut;
    if (is_in(at(out))) continue;
    while (out - in > kExactOut) (is_in(at(0.5 * (in + out))) ? in : out) = 0.5 * (in + out);
    if (out >= found.way) continue;
    found.way = out;
    found.clear = at(out);
  }
  return found;
}

std::vector<StandsIn> what_holds(const Stander& stander, const Pose2& X_WB, const WorldModel& world,
                                 std::span<const Item> items) {
  const std::vector<Thing> near = things_in({X_WB.position(), stander.reach}, world, items);
  if (near.empty()) return {};
  const RigidBody body = stander.body();
  std::vector<StandsIn> holds;
  std::vector<Thing> wider;  // What is around on the way out, found when something holds it.
  for (const Thing& thing : near) {
    if (!meets(stander, body, X_WB, thing)) continue;
    if (wider.empty()) wider = things_in({X_WB.position(), stander.reach + kFarOut}, world, items);
    const Thing& all = named(thing.name, wider);
    holds.push_back(
        way_out(thing.name, X_WB, [&](const Pose2& at) { return meets(stander, body, at, all); }));
  }
  return holds;
}

}  // namespace

std::vector<StandsIn> what_holds(const RobotModel& robot, const Pose2& X_WB, const WorldModel& world) {
  if (robot.fixed) return {};
  return what_holds(Stander(robot, Extent::with_paddles), X_WB, world, world.items);
}

std::vector<StandsIn> what_holds(const Item& item, const WorldModel& world) {
  const auto before = std::ranges::find(world.items, item.name, &Item::name);
  return what_holds(Stander(item), item.pose, world, {world.items.begin(), before});
}

std::optional<std::string> obstacle_in(const RobotModel& robot, const Pose2& X_WB, const WorldModel& world) {
  if (robot.fixed) return std::nullopt;
  const Stander stander(robot, Extent::solid);
  const std::vector<Thing> near = obstacles_in({X_WB.position(), stander.reach}, world);
  if (near.empty()) return std::nullopt;
  const RigidBody body = stander.body();
  for (const Thing& thing : near)
    if (meets(stander, body, X_WB, thing)) return thing.name;
  return std::nullopt;
}

std::string how_to_clear(const StandsIn& there) {
  if (!there.clear) return "not clear of it within 5 m";
  const auto rounded = [](double value) { return xml::number_text(std::round(1000.0 * value) / 1000.0); };
  return xml::number_text(std::ceil(100.0 * there.way) / 100.0) + " m from being clear of it at x " +
         rounded(there.clear->x) + " m, y " + rounded(there.clear->y) + " m";
}

bool stand_in_each_other(const RobotModel& robot, const Pose2& X_WB, const RobotModel& other,
                         const Pose2& X_WO, Extent extent) {
  const Stander one(robot, extent);
  const Stander two(other, extent);
  const bool near = norm(X_WB.position() - X_WO.position()) <= one.reach + two.reach;
  return near && one.body().meets(two.body(), in_space(X_WB).inverse() * in_space(X_WO));
}

StandsIn way_out_of(const RobotModel& other, const Pose2& X_WO, const RobotModel& robot, const Pose2& X_WB) {
  const RigidBody one = Stander(robot, Extent::with_paddles).body();
  const RigidBody two = Stander(other, Extent::with_paddles).body();
  return way_out("", X_WB,
                 [&](const Pose2& at) { return one.meets(two, in_space(at).inverse() * in_space(X_WO)); });
}

}  // namespace orca::sim
