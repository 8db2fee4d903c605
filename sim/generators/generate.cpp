// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/generate.hpp"

#include <algorithm>
#include <cmath>

#include "orca/xml/number.hpp"
#include "plan.hpp"
#include "reach.hpp"

namespace orca::sim {
namespace {

constexpr int kAttempts = 100;

bool has_ways(const WorldModel& world, double radius) {
  const detail::Reach reach(world, world.place("start")->pose.position(), radius);
  return std::ranges::all_of(world.places,
                             [&](const Place& place) { return reach.reaches(place.pose.position()); });
}

RandomStream numbers(std::uint64_t seed, int attempt) {
  return {seed, "generate", "attempt_" + std::to_string(attempt)};
}

}  // namespace

Result<WorldModel> generate(const Family& family, std::uint64_t seed, double radius) {
  if (!(radius > 0.0) || !std::isfinite(radius))
    return fail(Code::invalid_argument, "the radius of the robot must be more than 0 m");
  const std::string fault = std::visit([&](const auto& f) { return detail::fault_of(f, radius); }, family);
  if (!fault.empty()) return fail(Code::invalid_argument, fault);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    RandomStream random = numbers(seed, attempt);
    WorldModel world = std::visit([&](const auto& f) { return detail::draw(f, random); }, family);
    if (!detail::Reach::fits(world))
      return fail(Code::invalid_argument, "the world would be larger than 50,000 m2; make it smaller");
    if (has_ways(world, radius)) return world;
  }
  return fail(Code::unavailable,
              "in " + std::to_string(kAttempts) + " draws with seed " + std::to_string(seed) +
                  " a robot of radius " + xml::number_text(radius) +
                  " m never gets from start to goal; leave more room or take a smaller robot");
}

namespace detail {

std::size_t pick(RandomStream& random, std::size_t low, std::size_t high) {
  return low + static_cast<std::size_t>(random() % (high - low + 1));
}

std::string too_narrow(const std::string& what, double width, double radius) {
  const double needed = 2.0 * (radius + Reach::kPitch);
  if (width >= needed) return {};
  return what + " is " + xml::number_text(width) + " m; a robot of radius " + xml::number_text(radius) +
         " m needs " + xml::number_text(needed) + " m";
}

}  // namespace detail
}  // namespace orca::sim
