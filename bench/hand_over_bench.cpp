// SPDX-License-Identifier: GPL-3.0-or-later
// Time from one task to another by an Event alone: the cost of each back end of the executive.
#include "bare_fibers.hpp"
#include "bare_threads.hpp"
#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "processors.hpp"

namespace orca::bench {
namespace {

// Two tasks that notify each other.
class EventPair {
 public:
  explicit EventPair(Executive& executive)
      : here_(executive.make_event()),
        there_(executive.make_event()),
        task_(executive.spawn({"echo", 0}, [this] {
          while (!ending_) {
            there_->wait_until(kForever);
            here_->notify();
          }
        })) {}
  ~EventPair() {
    ending_ = true;
    there_->notify();
  }

  Nanoseconds time(int round_trips) {
    return time_per_operation(2 * round_trips, [&] {
      for (int i = 0; i < round_trips; ++i) {
        there_->notify();
        here_->wait_until(kForever);
      }
    });
  }

 private:
  std::unique_ptr<Event> here_;
  std::unique_ptr<Event> there_;
  std::atomic<bool> ending_{false};
  std::unique_ptr<Task> task_;
};

template <class Bare>
void compare_with(benchmark::State& state, Row& row, const ExecutiveOptions& options, int round_trips) {
  run_on(options, [&](Executive& executive) {
    EventPair pair(executive);
    Bare bare;
    alternate(
        state, row, round_trips, [&](int n) { return pair.time(n); }, [&](int n) { return bare.time(n); });
  });
}

void jump(benchmark::State& state, Row& row) {
  BareJump bare;
  measure(state, row, 200, [&](int n) { return bare.time(n); });
}

}  // namespace

void register_hand_over() {
  using Clock = ClockKind;
  add_row({"Boost.Context: into a fiber and back", ""}, 500, jump);
  add_row({"hand-over: fibers", "bare fiber hand-over"}, 2000, [](auto& state, Row& row) {
    compare_with<BareFiberPair>(state, row, {Clock::steady, Backend::fiber}, 50);
  });
  add_row({"hand-over: fibers, virtual time", "bare fiber hand-over"}, 2000, [](auto& state, Row& row) {
    compare_with<BareFiberPair>(state, row, {Clock::virtual_time, Backend::fiber}, 50);
  });
  add_row({"hand-over: threads", "ring + futex"}, 2000, [](auto& state, Row& row) {
    compare_with<FutexRingPair>(state, row, {Clock::steady, Backend::thread}, 5);
  });
  add_row({"hand-over: baton threads", "ring + futex"}, 2000, [](auto& state, Row& row) {
    compare_with<FutexRingPair>(state, row, {Clock::virtual_time, Backend::baton}, 5);
  });
}

}  // namespace orca::bench
