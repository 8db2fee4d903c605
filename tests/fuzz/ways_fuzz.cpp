// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a topological map or errors. Ways through a map that was read lead along its legs.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "orca/planning/ways.hpp"
#include "orca/planning/ways_file.hpp"

namespace {

using namespace orca::planning;

constexpr double kNoWay = std::numeric_limits<double>::infinity();

bool is_leg(const Ways& ways, std::size_t from, std::size_t to) {
  return std::ranges::any_of(ways.legs, [&](const WayLeg& leg) {
    return (leg.from == from && leg.to == to) || (!leg.one_way && leg.from == to && leg.to == from);
  });
}

// Drives from the first point, from whichever side, to the last one.
void drive(const Ways& ways) {
  const std::size_t count = ways.points.size();
  if (count == 0 || count > 200) return;
  std::vector<double> start(2 * count, kNoWay);
  std::vector<double> goal(2 * count, kNoWay);
  const std::vector<double> points(count, 0.0);
  const std::vector<double> legs(ways.legs.size(), 0.0);
  start[0] = start[1] = 0.0;
  goal[2 * count - 2] = goal[2 * count - 1] = 0.0;
  const auto way = cheapest_way(ways, {start, goal, points, legs});
  if (!way) return;
  if (way->points.empty() || way->points.front() != 0 || way->points.back() != count - 1) std::abort();
  if (way->costs.size() != way->points.size() || !(way->cost >= 0.0)) std::abort();
  for (std::size_t i = 0; i + 1 < way->points.size(); ++i)
    if (!is_leg(ways, way->points[i], way->points[i + 1])) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orca::xml::Diagnostics diagnostics;
  const auto ways = read_ways_text({reinterpret_cast<const char*>(data), size}, "fuzz.xml", diagnostics);
  if (ways.has_value() == diagnostics.has_errors()) std::abort();
  if (!ways) return 0;
  for (const WayLeg& leg : ways->legs)
    if (leg.from >= ways->points.size() || leg.to >= ways->points.size() || !(leg.cost > 0.0)) std::abort();
  drive(*ways);
  return 0;
}
