// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one push to a waiting component: from the call of push() until the component has the object.
#include "bare_fibers.hpp"
#include "bare_threads.hpp"
#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "processors.hpp"
#include "push_pair.hpp"

namespace orca::bench {
namespace {

template <class Bare>
void beside(benchmark::State& state, Row& row, const ExecutiveOptions& options, std::size_t ranges,
            int round_trips) {
  run_on(options, [&](Executive& executive) {
    PushPair pair(executive, ranges);
    Bare bare;
    alternate(
        state, row, round_trips, [&](int n) { return pair.time(n); }, [&](int n) { return bare.time(n); });
  });
}

// A large object beside a small one, on the same executor.
void beside_small(benchmark::State& state, Row& row) {
  run_on(kFibers, [&](Executive& executive) {
    PushPair large(executive, kImage);
    PushPair small(executive, kSmall);
    alternate(
        state, row, 20, [&](int n) { return large.time(n); }, [&](int n) { return small.time(n); });
  });
}

// Both threads spin, so each needs a processor of its own.
void spinning(benchmark::State& state, Row& row) {
  const AllProcessors all;
  if (at_start().count() < 2) return state.SkipWithError("needs two processors");
  ExecutiveOptions options;
  options.spin = 200us;
  beside<FutexRingPair>(state, row, options, kLaser, 20);
}

void beside_copy(benchmark::State& state, Row& row) {
  run_on(kFibers, [&](Executive& executive) {
    PushPair pair(executive, kImage);
    alternate(
        state, row, 20, [&](int n) { return pair.time(n); }, copy_image);
  });
}

}  // namespace

void register_push() {
  add_row({"push 3 KB, same executor", "bare fiber hand-over", ratio_at_most(2.0)}, 2000,
          [](auto& state, Row& row) { beside<BareFiberPair>(state, row, kFibers, kLaser, 50); });
  add_row({"push 1 MB, same executor", "push 16 B, same executor", ratio_at_most(1.2)}, 200, beside_small);
  add_row({"push 1 MB, same executor", "memcpy of 1 MB"}, 100, beside_copy);
  add_row({"push 3 KB, to a blocked thread", "ring + futex", ratio_at_most(1.25)}, 2000,
          [](auto& state, Row& row) { beside<FutexRingPair>(state, row, kThreads, kLaser, 5); });
  add_row({"push 3 KB, to a spinning thread (two cores)", "ring + futex (two cores)"}, 500, spinning);
}

}  // namespace orca::bench
