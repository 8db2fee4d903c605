// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/missing_runs.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace orca::batch {

bool MissingRuns::is_missing(std::size_t run) const {
  if (!shard_.holds(experiment_, run)) return false;
  const Run one = experiment_.run(run);
  return !store_.has(experiment_.variants[one.variant].name, experiment_.worlds[one.world].name, one.seed);
}

std::optional<std::size_t> MissingRuns::next() {
  while (next_ < experiment_.run_count())
    if (const std::size_t run = next_++; is_missing(run)) return run;
  return std::nullopt;
}

std::size_t MissingRuns::count() const {
  std::size_t count = 0;
  for (std::size_t run = 0; run < experiment_.run_count(); ++run)
    if (is_missing(run)) ++count;
  return count;
}

std::size_t MissingRuns::count_with(const std::vector<std::size_t>& twice) const {
  const auto there = std::ranges::count_if(twice, [&](std::size_t run) { return !is_missing(run); });
  return count() + static_cast<std::size_t>(there);
}

namespace {

// A run that depends on one bit of an address comes out the same by chance in half of the cases: in all of these, in 1 of 128.
constexpr std::size_t kMostOfFew = 7;
constexpr std::size_t kShareOfFew = 7;     // one run in so many, up to kMostOfFew of a variant
constexpr std::size_t kShareOfMany = 100;  // one run in so many, beyond

std::size_t rounded_up(std::size_t count, std::size_t part) { return (count + part - 1) / part; }

}  // namespace

std::vector<std::size_t> MissingRuns::not_repeated() const {
  std::map<std::string, std::size_t> known;
  for (const RepeatRow& row : store_.repeats()) ++known[row.variant];
  const std::size_t variants = experiment_.variants.size();
  const std::size_t places = experiment_.run_count() / variants;
  const std::size_t own = places / shard_.count + (shard_.number <= places % shard_.count ? 1 : 0);
  const std::size_t count =
      std::max(std::min(kMostOfFew, rounded_up(own, kShareOfFew)), rounded_up(own, kShareOfMany));
  std::vector<std::size_t> runs;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place = k * own / count * shard_.count + shard_.number - 1;
    for (std::size_t variant = 0; variant < variants; ++variant)
      if (known[experiment_.variants[variant].name] <= k) runs.push_back(place * variants + variant);
  }
  return runs;
}

}  // namespace orca::batch
