// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/base/result.hpp"
#include "orca/batch/statistics/interval.hpp"

namespace orca::batch {

/// Returns Wilson's score interval (95 %, no continuity correction) for the rate of `successes` among `runs` runs. It lies
/// in [0, 1], begins at exactly 0 if nothing succeeded, ends at exactly 1 if everything did, and has no zero width.
///
/// The runs are taken as independent of each other. Several seeds of one world are not: bootstrap_mean() knows worlds.
/// @pre     both below 2^53
/// @errors  invalid_argument if there are no runs, or more successes than runs.
/// @thread  a pure function; any thread.
/// @source  Wilson, "Probable inference, the law of succession, and statistical inference", JASA 22, 1927; as in section 3.1 of
///          Brown, Cai and DasGupta, "Interval estimation for a binomial proportion", Statistical Science 16(2), 2001. It
///          equals SciPy's binomtest(successes, runs).proportion_ci(0.95, method="wilson").
[[nodiscard]] Result<Interval> wilson_interval(std::uint64_t successes, std::uint64_t runs);

}  // namespace orca::batch
