// SPDX-License-Identifier: GPL-3.0-or-later
// The link through shared memory: time of one push and of one question between two processes, on one processor.
#include "bare_processes.hpp"
#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "process_pair.hpp"

namespace orca::bench {
namespace {

constexpr std::size_t kMessage = 128;  // [bytes] about a question with its header

void push_beside_ring(benchmark::State& state, Row& row, std::size_t ranges, int round_trips) {
  run_on(kThreads, [&](Executive& executive) {
    ProcessPushPair pair(executive, ranges);
    BareProcessPair bare(ranges * sizeof(double));
    alternate(
        state, row, round_trips, [&](int n) { return pair.time(n); }, [&](int n) { return bare.time(n); });
  });
}

void push_beside_copy(benchmark::State& state, Row& row) {
  run_on(kThreads, [&](Executive& executive) {
    ProcessPushPair pair(executive, kImage);
    alternate(
        state, row, 1, [&](int n) { return pair.time(n); }, copy_image);
  });
}

void query_beside_ring(benchmark::State& state, Row& row) {
  run_on(kThreads, [&](Executive& executive) {
    ProcessQueryPair pair(executive);
    BareProcessPair bare(kMessage);
    alternate(
        state, row, 5, [&](int n) { return pair.time(n); }, [&](int n) { return 2 * bare.time(n); });
  });
}

}  // namespace

void register_shm() {
  add_row({"push 3 KB between processes", "ring + futex between processes", ratio_at_most(1.6)}, 2000,
          [](auto& state, Row& row) { push_beside_ring(state, row, kLaser, 5); });
  add_row({"push 1 MB between processes", "memcpy of 1 MB", ratio_at_most(2.5)}, 200, push_beside_copy);
  add_row({"query between processes", "two messages, ring + futex", ratio_at_most(1.6)}, 2000,
          query_beside_ring);
}

}  // namespace orca::bench
