// SPDX-License-Identifier: LGPL-3.0-or-later
#include "steering.hpp"

#include <cmath>

namespace orca::vfh {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Returns how far [rad] a direction lies to the left of another, in [0, 2 pi).
double left_of(double border, double direction) {
  const double angle = std::fmod(direction - border, kTurn);
  return angle < 0.0 ? angle + kTurn : angle;
}

std::size_t free_from(std::size_t first, const Blocked& blocked) {
  std::size_t width = 0;
  while (width < kSectors && !blocked[(first + width) % kSectors]) ++width;
  return width;
}

}  // namespace

std::vector<Valley> valleys(const Blocked& blocked) {
  if (blocked.none()) return {{0, kSectors}};
  std::vector<Valley> found;
  for (std::size_t k = 0; k < kSectors; ++k) {
    const bool border = blocked[(k + kSectors - 1) % kSectors] && !blocked[k];
    if (border) found.push_back({k, free_from(k, blocked)});
  }
  return found;
}

std::vector<double> candidates(const Valley& valley, double target, double wide) {
  if (valley.width == kSectors) return {target};
  const double right = static_cast<double>(valley.right) * kSector;
  const double left = right + static_cast<double>(valley.width - 1) * kSector;
  if (left - right <= wide) return {0.5 * (right + left)};
  const double first = right + 0.5 * wide;
  const double last = left - 0.5 * wide;
  std::vector<double> offered{first, last};
  if (left_of(first, target) <= last - first) offered.push_back(target);
  return offered;
}

double cost(double direction, const Aim& aim, const Costs& costs) {
  return costs.target * apart(direction, aim.target) + costs.heading * apart(direction, aim.heading) +
         (aim.last ? costs.last * apart(direction, *aim.last) : 0.0);
}

std::optional<double> cheapest(const Blocked& blocked, const Aim& aim, double wide, const Costs& costs) {
  std::optional<double> best;
  for (const Valley& valley : valleys(blocked))
    for (const double direction : candidates(valley, aim.target, wide))
      if (!best || cost(direction, aim, costs) < cost(*best, aim, costs)) best = direction;
  return best;
}

std::optional<Choice> steer(std::span<const Cell> cells, const Motion& motion, double target,
                            const Settings& settings, State& state) {
  const Densities densities = primary_histogram(cells, settings.around);
  state.blocked = binary_histogram(densities, state.blocked, settings.thresholds);
  const Aim aim{target, motion.heading, state.last};
  const Blocked masked = masked_histogram(state.blocked, cells, settings.around, motion);
  std::optional<double> direction = cheapest(masked, aim, settings.wide, settings.costs);
  const bool at_rest = !direction;
  if (at_rest) direction = cheapest(state.blocked, aim, settings.wide, settings.costs);
  if (!direction) return std::nullopt;
  state.last = direction;
  return Choice{*direction, at_rest};
}

}  // namespace orca::vfh
