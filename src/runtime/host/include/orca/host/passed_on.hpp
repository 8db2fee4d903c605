// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace orca::host {

/// Returns whether an Arrived or a GoalFailed tells of the same moment of the same mission as one of the last ones: a component
/// that stands between two others, as Porter between Command and Goto, has only passed it on.
/// @thread  pure function; any thread.
template <class Result>
[[nodiscard]] bool is_passed_on(const std::vector<Result>& before, const Result& result) {
  constexpr std::ptrdiff_t kLast = 16;
  const auto end = before.end();
  const auto begin = end - std::min(kLast, std::distance(before.begin(), end));
  return std::any_of(begin, end, [&](const Result& known) {
    return known.mission() == result.mission() && known.name() == result.name() &&
           known.stamp() == result.stamp();
  });
}

}  // namespace orca::host
