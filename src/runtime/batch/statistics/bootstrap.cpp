// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/bootstrap.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "input_checks.hpp"
#include "orca/base/random.hpp"
#include "sorted_values.hpp"

namespace orca::batch {
namespace {

// Returns a number in [0, count), each equally likely, by Lemire's multiplication with rejection (ACM TOMACS 29(1), 2019).
std::size_t drawn_index(RandomStream& random, std::uint32_t count) {
  std::uint64_t product = (random() >> 32) * count;
  if (static_cast<std::uint32_t>(product) < count) {
    const std::uint32_t unfair = (0U - count) % count;
    while (static_cast<std::uint32_t>(product) < unfair) product = (random() >> 32) * count;
  }
  return static_cast<std::size_t>(product >> 32);
}

// The values of all worlds one after the other, as differences from `origin`: sums of equal values are exact then.
struct FlatWorlds {
  struct World {
    std::size_t begin;
    std::uint32_t count;
  };
  double origin = 0.0;
  std::vector<double> values;
  std::vector<World> worlds;

  explicit FlatWorlds(ValuesByWorld nested) : origin(nested.front().front()) {
    std::size_t total = 0;
    for (const std::vector<double>& world : nested) total += world.size();
    values.reserve(total);
    for (const std::vector<double>& world : nested) {
      worlds.push_back({values.size(), static_cast<std::uint32_t>(world.size())});
      for (const double value : world) values.push_back(value - origin);
    }
  }
};

double mean_of_resample(const FlatWorlds& flat, RandomStream& random) {
  const auto world_count = static_cast<std::uint32_t>(flat.worlds.size());
  double sum = 0.0;
  std::uint64_t drawn = 0;
  for (std::uint32_t i = 0; i < world_count; ++i) {
    const FlatWorlds::World& world = flat.worlds[drawn_index(random, world_count)];
    for (std::uint32_t k = 0; k < world.count; ++k)
      sum += flat.values[world.begin + drawn_index(random, world.count)];
    drawn += world.count;
  }
  return flat.origin + sum / static_cast<double>(drawn);
}

}  // namespace

Result<Estimate> bootstrap_mean(ValuesByWorld worlds, const BootstrapOptions& options) {
  if (options.draws == 0) return fail(Code::invalid_argument, "a bootstrap needs at least one draw");
  if (const Status status = check_worlds(worlds); !status) return status.error();
  const FlatWorlds flat(worlds);
  RandomStream random(options.seed, "batch", "bootstrap");
  std::vector<double> means(options.draws);
  for (double& mean : means) mean = mean_of_resample(flat, random);
  std::ranges::sort(means);
  return Estimate{flat.origin + mean_of(flat.values),
                  {quantile_of_sorted(means, 0.025), quantile_of_sorted(means, 0.975)}};
}

Result<Estimate> bootstrap_difference(ValuesByWorld first, ValuesByWorld second,
                                      const BootstrapOptions& options) {
  const Result<std::vector<std::vector<double>>> differences = paired_differences(first, second);
  if (!differences) return differences.error();
  return bootstrap_mean(*differences, options);
}

}  // namespace orca::batch
