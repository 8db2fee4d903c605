// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdlib>

namespace orca::test {

/// Returns whether this is a run of the slow tests, which set ORCA_SLOW (orca_add_slow_run in cmake/OrcaTests.cmake).
inline bool is_slow_run() { return std::getenv("ORCA_SLOW") != nullptr; }

/// Returns how many of `all` random cases a run tries: all in the slow tests, else the first tenth.
template <std::integral N>
N part_of(N all) {
  return is_slow_run() ? all : std::max<N>(1, all / 10);
}

}  // namespace orca::test
