// SPDX-License-Identifier: LGPL-3.0-or-later
#include <numbers>

#include "plan.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kDeep = 5.0;       // [m] A room, clear.
constexpr double kNarrowest = 4.0;  // [m] Room, between the walls' centre lines.
constexpr double kWidest = 7.0;
constexpr double kMinJamb = 0.4;      // [m] Least wall beside a door.
constexpr double kKeepFree = 0.8;     // [m] Around a room's middle, for the place there.
constexpr double kBeforeStart = 1.0;  // [m] From the corridor's end to the start.

// The rooms of one side, as the places of their walls' centre lines along x [m], first and last included.
using Cuts = std::vector<double>;

Cuts cuts(std::size_t rooms, RandomStream& random) {
  Cuts at{0.0};
  for (std::size_t i = 0; i < rooms; ++i) at.push_back(at.back() + random.uniform(kNarrowest, kWidest));
  return at;
}

// Returns the same rooms, stretched to end at `length` [m].
Cuts stretched(Cuts at, double length) {
  const double ratio = length / at.back();
  for (double& x : at) x *= ratio;
  at.back() = length;
  return at;
}

struct Side {
  Cuts at;
  double inner, outer;  // [m] y of the corridor's wall and of the building's, centre lines.
};

void add_doors(WorldModel& world, const Side& side, double door, RandomStream& random) {
  std::vector<Opening> doors;
  for (std::size_t i = 0; i + 1 < side.at.size(); ++i) {
    const double margin = kMinJamb + 0.5 * (door + kThickness);
    doors.push_back({random.uniform(side.at[i] + margin, side.at[i + 1] - margin), door});
  }
  add_wall(world, {side.at.front(), side.inner}, {side.at.back(), side.inner}, std::move(doors));
}

// Adds a table, shelf or column somewhere in the room, away from its middle.
void add_piece(WorldModel& world, const Bounds& room, RandomStream& random) {
  const double length = random.uniform(0.4, 1.6);
  const double width = random.uniform(0.3, 0.8);
  const double height = random.uniform(0.5, 2.0);
  const bool round = random.chance(0.25);
  const Vec2 size = random.chance(0.5) ? Vec2{length, width} : Vec2{width, length};
  const Vec2 low{random.uniform(room.low.x, room.high.x - size.x),
                 random.uniform(room.low.y, room.high.y - size.y)};
  const Vec2 middle = low + 0.5 * size;
  const Shape shape =
      round ? Shape{Circle{middle, 0.5 * width}} : Shape{Box{{middle.x, middle.y, 0.0}, 0.5 * size}};
  if (distance(shape, 0.5 * (room.low + room.high)) < kKeepFree) return;
  world.obstacles.push_back({"furniture", shape, height});
}

void add_rooms(WorldModel& world, const Side& side, const OfficeFloor& family, RandomStream& random) {
  add_doors(world, side, family.door, random);
  for (std::size_t i = 0; i + 1 < side.at.size(); ++i) {
    if (i > 0) add_wall(world, {side.at[i], side.inner}, {side.at[i], side.outer});
    Bounds room;
    room.add(Vec2{side.at[i] + 0.5 * kThickness, side.inner});
    room.add(Vec2{side.at[i + 1] - 0.5 * kThickness, side.outer});
    room.low.y += 0.5 * kThickness;
    room.high.y -= 0.5 * kThickness;
    for (std::size_t k = 0; k < family.furniture; ++k) add_piece(world, room, random);
    const Vec2 middle = 0.5 * (room.low + room.high);
    const double into = side.outer > side.inner ? 0.5 * std::numbers::pi : -0.5 * std::numbers::pi;
    world.places.push_back({"room_" + std::to_string(world.places.size()), {middle.x, middle.y, into}});
  }
}

}  // namespace

WorldModel draw(const OfficeFloor& family, RandomStream& random) {
  const Cuts south = cuts(family.rooms, random);
  const double length = south.back();
  const Cuts north = stretched(cuts(family.rooms, random), length);
  const double deep = kDeep + kThickness;
  const double across = family.corridor + kThickness;
  WorldModel world;
  const double half = 0.5 * kThickness;
  add_hall(world, {half, half - deep}, {length - half, across + deep - half});
  world.places.push_back({"start", {kBeforeStart, 0.5 * across, 0.0}});
  add_rooms(world, {south, 0.0, -deep}, family, random);
  add_rooms(world, {north, across, across + deep}, family, random);
  const std::size_t last = pick(random, 1, 2) * family.rooms;  // The far room of either side.
  world.places.push_back({"goal", world.places[last].pose});
  return world;
}

std::string fault_of(const OfficeFloor& family, double radius) {
  if (family.rooms < 1 || family.rooms > 10) return "rooms must be between 1 and 10";
  if (family.furniture > 20) return "furniture must be at most 20";
  if (!(family.door <= 1.2)) return "door must be at most 1.2 m";
  if (!(family.corridor <= 10.0)) return "corridor must be at most 10 m";
  if (const std::string fault = too_narrow("corridor", family.corridor, radius); !fault.empty()) return fault;
  return too_narrow("door", family.door, radius);
}

}  // namespace orca::sim::detail
