// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <numbers>

#include "families.hpp"
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

}  // namespace orca::sim::detail
