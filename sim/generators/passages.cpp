// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <numbers>

#include "orca/xml/number.hpp"
#include "plan.hpp"

namespace orca::sim::detail {
namespace {

// Draws the centre line. Every other leg goes to the east, so that the corridor never meets itself.
std::vector<Vec2> centre_line(const Corridor& family, RandomStream& random) {
  std::vector<Vec2> line{{0.0, 0.0}};
  for (std::size_t leg = 0; leg < family.legs; ++leg) {
    const double length = random.uniform(family.shortest, family.longest);
    const double up = random.chance(0.5) ? 1.0 : -1.0;
    line.push_back(line.back() + (leg % 2 == 0 ? Vec2{length, 0.0} : Vec2{0.0, up * length}));
  }
  return line;
}

Vec2 towards(const std::vector<Vec2>& line, std::size_t leg) {
  const Vec2 way = line[leg + 1] - line[leg];
  return 1.0 / norm(way) * way;
}

// Returns the line `offset` [m] to the left of a line with right angles; its ends are extended by the same
// length.
std::vector<Vec2> beside(const std::vector<Vec2>& line, double offset) {
  const auto left = [](Vec2 v) { return Vec2{-v.y, v.x}; };
  const double out = std::fabs(offset);
  std::vector<Vec2> side;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool first = i == 0;
    const bool last = i + 1 == line.size();
    const Vec2 in = towards(line, first ? 0 : i - 1);
    const Vec2 on = towards(line, last ? i - 1 : i);
    const Vec2 shift = first || last ? left(on) : left(in) + left(on);
    const Vec2 end = first ? -out * on : last ? out * on : Vec2{};
    side.push_back(line[i] + offset * shift + end);
  }
  return side;
}

constexpr double kApart = 3.0;     // [m] From the trap to start and goal.
constexpr double kMargin = 1.0;    // [m] From start and goal to the hall's ends.
constexpr double kLargest = 50.0;  // [m]

constexpr double kJamb = 0.3;  // [m] Least wall beside a door.

}  // namespace

WorldModel draw(const Corridor& family, RandomStream& random) {
  const std::vector<Vec2> line = centre_line(family, random);
  const double half = 0.5 * (family.width + kThickness);
  const std::array<std::vector<Vec2>, 2> sides{beside(line, half), beside(line, -half)};
  WorldModel world;
  for (const std::vector<Vec2>& side : sides)
    for (std::size_t i = 0; i + 1 < side.size(); ++i) add_wall(world, side[i], side[i + 1]);
  add_wall(world, sides[0].front(), sides[1].front());
  add_wall(world, sides[0].back(), sides[1].back());
  const bool ends_east = family.legs % 2 == 1;
  const double up = line.back().y >= line[line.size() - 2].y ? 1.0 : -1.0;
  const double yaw = ends_east ? 0.0 : up * 0.5 * std::numbers::pi;
  world.places = {{"start", {line.front().x, line.front().y, 0.0}},
                  {"goal", {line.back().x, line.back().y, yaw}}};
  return world;
}

std::string fault_of(const Corridor& family, double radius) {
  if (family.legs < 1 || family.legs > 50) return "legs must be between 1 and 50";
  if (!(family.shortest <= family.longest)) return "shortest must not be more than longest";
  if (!(family.longest <= 20.0)) return "longest must be at most 20 m";
  const double least = 2.0 * (family.width + kThickness);
  if (!(family.shortest >= least))
    return "shortest must be at least " + xml::number_text(least) +
           " m, twice the width with a wall, so that legs stay apart";
  return too_narrow("width", family.width, radius);
}

WorldModel draw(const UTrap& family, RandomStream& random) {
  const double width = family.width * random.uniform(0.8, 1.2);
  const double depth = family.depth * random.uniform(0.8, 1.2);
  const double mouth = kMargin + kApart;
  const double half = 0.5 * (width + kThickness);  // To the middle of the U's arms.
  const double hall = width + 2.0 * (kThickness + family.beside);
  const double y = 0.5 * hall;
  const double bottom = mouth + depth + 0.5 * kThickness;
  WorldModel world;
  add_hall(world, {0.0, 0.0}, {bottom + kApart + kMargin, hall});
  add_wall(world, {mouth, y - half}, {bottom, y - half});
  add_wall(world, {mouth, y + half}, {bottom, y + half});
  add_wall(world, {bottom, y - half}, {bottom, y + half});
  const double across = 0.25 * width;
  const double start = y + random.uniform(-across, across);
  const double goal = y + random.uniform(-across, across);
  world.places = {{"start", {kMargin, start, 0.0}}, {"goal", {bottom + kApart, goal, 0.0}}};
  return world;
}

std::string fault_of(const UTrap& family, double radius) {
  for (const double value : {family.width, family.depth, family.beside})
    if (!(value > 0.0 && value <= kLargest))
      return "width, depth and beside must be more than 0 and at most 50 m";
  return too_narrow("beside", family.beside, radius);
}

WorldModel draw(const NarrowDoors& family, RandomStream& random) {
  WorldModel world;
  const double nearest = kJamb + 0.5 * family.door;
  const double length = static_cast<double>(family.walls + 1) * family.spacing;
  add_hall(world, {0.0, 0.0}, {length, family.width});
  for (std::size_t i = 1; i <= family.walls; ++i) {
    const double x = static_cast<double>(i) * family.spacing;
    const double at = random.uniform(nearest, family.width - nearest);
    add_wall(world, {x, 0.0}, {x, family.width}, {{at, family.door}});
  }
  const double y = 0.5 * family.width;
  world.places = {{"start", {0.5 * family.spacing, y, 0.0}},
                  {"goal", {length - 0.5 * family.spacing, y, 0.0}}};
  return world;
}

std::string fault_of(const NarrowDoors& family, double radius) {
  if (family.walls < 1 || family.walls > 50) return "walls must be between 1 and 50";
  if (!(family.spacing <= 20.0 && family.width <= 50.0))
    return "spacing must be at most 20 m, width at most 50 m";
  if (!(family.width >= family.door + 2.0 * kJamb))
    return "the hall's width must be that of a door and 0.6 m more";
  if (const std::string fault = too_narrow("spacing", family.spacing - kThickness, radius); !fault.empty())
    return fault;
  return too_narrow("door", family.door, radius);
}

}  // namespace orca::sim::detail
