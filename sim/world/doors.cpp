// SPDX-License-Identifier: LGPL-3.0-or-later
#include "doors.hpp"

#include <algorithm>
#include <functional>

#include "orca/base/portable_math.hpp"
#include "orca/base/random.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kTakes = 1.5;   // [s] from shut to open; own estimate
constexpr double kAtHand = 0.6;  // [m] from the rim of a person to a leaf that it opens

double length_of(const Door& door) { return norm(door.shut.b - door.shut.a); }

Vec2 middle_of(const Segment& segment) { return 0.5 * (segment.a + segment.b); }

double yaw_of(const Segment& segment) {
  const Vec2 way = segment.b - segment.a;
  return portable::atan2(way.y, way.x);
}

double distance_to(const Segment& segment, Vec2 point) {
  const Vec2 way = segment.b - segment.a;
  const double along = std::clamp(dot(point - segment.a, way) / dot(way, way), 0.0, 1.0);
  return norm(segment.a + along * way - point);
}

bool is_at_hand(const Person& person, const Door& door) {
  return distance_to(door.shut, person.position) <= person.radius + kAtHand;
}

Duration drawn_time(const DoorTurn& turn, RandomStream random) {
  if (!turn.latest) return turn.at;
  return from_seconds(random.uniform(to_seconds(turn.at), to_seconds(*turn.latest)));
}

}  // namespace

Pose2 pose_at(const Door& door, double share) {
  const double yaw = yaw_of(door.shut);
  if (door.slides) {
    const Vec2 middle = middle_of(door.shut) - share * (door.shut.b - door.shut.a);
    return {middle.x, middle.y, yaw};
  }
  const double turned = wrapped(yaw + share * door.swing);
  const Vec2 middle = door.shut.a + 0.5 * length_of(door) * direction(turned);
  return {middle.x, middle.y, turned};
}

Doors::Doors(const WorldModel& world, std::uint64_t seed) {
  for (const Door& door : world.doors) leaves_.push_back({&door, door.open, door.open ? 1.0 : 0.0});
  for (std::size_t i = 0; i < world.events.turns.size(); ++i) {
    const DoorTurn& turn = world.events.turns[i];
    const auto leaf = std::ranges::find(leaves_, turn.door, [](const Leaf& one) { return one.door->name; });
    if (leaf == leaves_.end()) continue;
    const RandomStream random(seed, turn.door, "door " + std::to_string(i));
    turns_.push_back({&*leaf, turn.opens, TimePoint{} + drawn_time(turn, random)});
  }
  std::ranges::stable_sort(turns_, std::ranges::greater{}, &Turn::at);
}

void Doors::work(World& world, std::vector<std::string>& notes) {
  for (; !turns_.empty() && turns_.back().at <= world.time(); turns_.pop_back())
    turn(*turns_.back().leaf, turns_.back().opens, notes);
  for (Leaf& leaf : leaves_) {
    follow_people(leaf, world, notes);
    move(leaf, world);
  }
}

// Returns false if it is so already.
bool Doors::turn(Leaf& leaf, bool opens) {
  if (leaf.opens == opens) return false;
  leaf.opens = opens;
  leaf.by_people = false;
  return true;
}

void Doors::turn(Leaf& leaf, bool opens, std::vector<std::string>& notes) {
  if (turn(leaf, opens)) notes.push_back(leaf.door->name + (opens ? " opens" : " shuts"));
}

std::vector<DoorState> Doors::states() const {
  std::vector<DoorState> all;
  for (const Leaf& leaf : leaves_) {
    const Pose2 pose = pose_at(*leaf.door, leaf.share);
    const Vec2 half = 0.5 * length_of(*leaf.door) * direction(pose.yaw);
    all.push_back({leaf.door->name, {pose.position() - half, pose.position() + half}, leaf.opens});
  }
  return all;
}

Status Doors::turn(const World& world, std::string_view name, bool opens) {
  const auto leaf = std::ranges::find(leaves_, name, [](const Leaf& one) { return one.door->name; });
  if (leaf == leaves_.end()) return fail(Code::not_found, "there is no door '" + std::string(name) + "'");
  if (!opens)
    for (const Person& person : people_in(world))
      if (is_at_hand(person, *leaf->door))
        return fail(Code::failed_precondition, person.name + " is at the door and holds it open");
  if (!turn(*leaf, opens))
    return fail(Code::failed_precondition, leaf->door->name + (opens ? " is open" : " is shut") + " already");
  return ok();
}

// Somebody who stands in the doorway holds the leaf.
void Doors::follow_people(Leaf& leaf, const World& world, std::vector<std::string>& notes) {
  for (const Person& person : people_in(world)) {
    if (!is_at_hand(person, *leaf.door)) continue;
    turn(leaf, true, notes);
    leaf.left = world.time();
    leaf.by_people = true;
  }
  if (leaf.by_people && leaf.door->closer && world.time() - leaf.left >= *leaf.door->closer)
    turn(leaf, false, notes);
}

void Doors::move(Leaf& leaf, World& world) {
  const Door& door = *leaf.door;
  if (!leaf.id) {
    const Box shape{{}, {0.5 * length_of(door), 0.5 * door.thickness}};
    if (const auto added = world.add_obstacle(door.name, shape, door.height, pose_at(door, leaf.share)))
      leaf.id = *added;
    return;
  }
  const double step = to_seconds(World::kTick) / kTakes;
  const double share = std::clamp(leaf.share + (leaf.opens ? step : -step), 0.0, 1.0);
  if (share != leaf.share && world.move_obstacle(*leaf.id, pose_at(door, share)).ok()) leaf.share = share;
}

}  // namespace orca::sim::detail
