// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/sample.hpp"

namespace orca::batch {

std::string Scope::text() const {
  if (worlds == 1) return " in this world";
  return worlds < kManyWorlds ? " in these " + std::to_string(worlds) + " worlds" : "";
}

Result<Sample> sample_of(ValuesByWorld worlds) {
  Result<std::vector<double>> means = world_means(worlds);
  if (!means) return means.error();
  Sample sample{{}, {worlds.size()}};
  if (sample.scope.over_worlds()) {
    sample.values = *std::move(means);
    return sample;
  }
  for (const std::vector<double>& runs : worlds)
    sample.values.insert(sample.values.end(), runs.begin(), runs.end());
  return sample;
}

}  // namespace orca::batch
