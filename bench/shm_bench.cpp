// SPDX-License-Identifier: GPL-3.0-or-later
// The link through shared memory: time of one push and of one question between two processes, on one processor.
#include "bare_processes.hpp"
#include "benchmarks.hpp"
#ifdef ORCA_BENCH_ICEORYX
#include "bare_iceoryx.hpp"
#endif
#include "comparison.hpp"
#include "on_executive.hpp"
#include "process_pair.hpp"

namespace orca::bench {
namespace {

constexpr std::size_t kMessage = 128;  // [bytes] about a question with its header

void push_beside_ring(benchmark::State& state, Row& row, std::size_t ranges, int round_trips) {
  run_on(kThreads, [&](Executive& executive) {
    ProcessPushPair<ScanLoad> pair(executive);
    BareProcessPair bare(ranges * sizeof(double));
    alternate(
        state, row, round_trips, [&](int n) { return pair.time(n, ranges); },
        [&](int n) { return bare.time(n); });
  });
}

void push_beside_copy(benchmark::State& state, Row& row) {
  run_on(kThreads, [&](Executive& executive) {
    ProcessPushPair<ScanLoad> pair(executive);
    alternate(
        state, row, 1, [&](int n) { return pair.time(n, kImage); }, copy_image);
  });
}

// An image of 1 MB beside one of 16 bytes, on the same edge.
void push_large_beside_small(benchmark::State& state, Row& row) {
  run_on(kThreads, [&](Executive& executive) {
    ProcessPushPair<ImageLoad> pair(executive);
    alternate(
        state, row, 5, [&](int n) { return pair.time(n, kImage * sizeof(double)); },
        [&](int n) { return pair.time(n, 16); });
  });
}

void push_beside_iceoryx([[maybe_unused]] benchmark::State& state, [[maybe_unused]] Row& row) {
#ifdef ORCA_BENCH_ICEORYX
  BareIceoryxPair bare(kImage * sizeof(double));
  run_on(kThreads, [&](Executive& executive) {
    ProcessPushPair<ImageLoad> pair(executive);
    alternate(
        state, row, 5, [&](int n) { return pair.time(n, kImage * sizeof(double)); },
        [&](int n) { return bare.time(n); });
  });
#else
  state.SkipWithError("iceoryx is not installed (libiceoryx-posh-dev, libacl1-dev)");
#endif
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
  add_row({"push an image of 1 MB between processes", "one of 16 bytes, same edge", ratio_at_most(1.3)}, 2000,
          push_large_beside_small);
  add_row({"push an image of 1 MB between processes", "iceoryx, a piece of 1 MB", ratio_at_most(2.0)}, 2000,
          push_beside_iceoryx);
  add_row({"query between processes", "two messages, ring + futex", ratio_at_most(1.6)}, 2000,
          query_beside_ring);
}

}  // namespace orca::bench
