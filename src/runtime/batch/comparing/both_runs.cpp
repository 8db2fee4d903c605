// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/difference.hpp"
#include "traced_run.hpp"

namespace orca::batch {

Result<PairOfRuns> make_both(const RunAgain& first, const RunAgain& second,
                             const std::function<bool()>& give_up) {
  Result<TracedRun> one = TracedRun::start(first, false);
  if (!one) return one.error();
  Result<TracedRun> other = TracedRun::start(second, true);
  if (!other) return other.error();
  for (std::size_t number = 1;; ++number) {
    Result<std::optional<Delivery>> a = one->next(give_up);
    if (!a) return a.error();
    Result<std::optional<Delivery>> b = other->next(give_up);
    if (!b) return b.error();
    if (*a != *b) return PairOfRuns{DeliveryDifference{number, *std::move(a), *std::move(b)}};
    if (!*a) return PairOfRuns{std::nullopt, one->outcome().trace_hash, other->outcome().trace_hash};
  }
}

}  // namespace orca::batch
