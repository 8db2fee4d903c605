// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/missing_runs.hpp"

#include <algorithm>

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

std::vector<std::size_t> MissingRuns::not_repeated() const {
  const std::vector<RepeatRow> known = store_.repeats();
  const std::size_t first = (shard_.number - 1) * experiment_.variants.size();
  std::vector<std::size_t> runs;
  if (first >= experiment_.run_count()) return runs;
  for (std::size_t i = 0; i < experiment_.variants.size(); ++i)
    if (std::ranges::find(known, experiment_.variants[i].name, &RepeatRow::variant) == known.end())
      runs.push_back(first + i);
  return runs;
}

}  // namespace orca::batch
