// SPDX-License-Identifier: GPL-3.0-or-later
// The cost of a stuck subscriber to its publisher and its siblings, compared with the same group without it.
#include <memory>
#include <semaphore>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "scans.hpp"

namespace orca::bench {
namespace {

// A publisher with two subscribers that take every object and, if wanted, a stuck one; all on threads. The
// first subscriber is the sibling that is measured.
class Group {
 public:
  Group(Executive& executive, bool with_stuck) : publisher_(executive), reached_(executive.make_event()) {
    for (const char* name : {"sibling", "other", "stuck"}) {
      if (subscribers_.size() == 2 && !with_stuck) break;
      subscribers_.push_back(std::make_unique<Subscriber>(executive, name));
      subscribe(publisher_, *subscribers_.back());
    }
    for (std::size_t i = 0; i < subscribers_.size(); ++i)
      scripts_.push_back(std::make_unique<test::Script>(
          *subscribers_[i], [this, i] { i == 2 ? let_go_.acquire() : take_all(i); }));
  }

  ~Group() { let_go_.release(); }

  /// Returns the time of push().
  Nanoseconds publish() {
    Loan<Scan> scan = std::move(make_scans(1, kLaser).front());
    const Nanoseconds taken = time_per_operation(1, [&] { publisher_.out.push(std::move(scan)); });
    reached_->wait_until(kForever);
    return taken;
  }

  /// Returns the time from push() until the sibling has the object.
  Nanoseconds reach_sibling() {
    Loan<Scan> scan = std::move(make_scans(1, kLaser).front());
    return time_per_operation(1, [&] {
      publisher_.out.push(std::move(scan));
      reached_->wait_until(kForever);
    });
  }

 private:
  void take_all(std::size_t i) {
    for (;;) {
      benchmark::DoNotOptimize(subscribers_[i]->in.get_update_wait());
      if (i == 0) reached_->notify();
    }
  }

  Publisher publisher_;
  std::unique_ptr<Event> reached_;
  std::binary_semaphore let_go_{0};  // the stuck subscriber waits here and ignores its port
  std::vector<std::unique_ptr<Subscriber>> subscribers_;
  std::vector<std::unique_ptr<test::Script>> scripts_;
};

void compare(benchmark::State& state, Row& row, Nanoseconds (Group::*measured)()) {
  run_on(kThreads, [&](Executive& executive) {
    Group with_stuck(executive, true);
    Group without(executive, false);
    alternate(
        state, row, 1, [&](int) { return (with_stuck.*measured)(); },
        [&](int) { return (without.*measured)(); });
  });
}

}  // namespace

void register_isolation() {
  add_row({"push beside a stuck subscriber", "without it", p99_ratio_at_most(1.05)}, 20000,
          [](auto& state, Row& row) { compare(state, row, &Group::publish); });
  add_row({"reaching the sibling of a stuck subscriber", "without it", p99_ratio_at_most(1.05)}, 20000,
          [](auto& state, Row& row) { compare(state, row, &Group::reach_sibling); });
}

}  // namespace orca::bench
