// SPDX-License-Identifier: GPL-3.0-or-later
// What a subscriber that has got stuck costs its publisher and its siblings: the same with a healthy one in
// its place.
#include <memory>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "scans.hpp"

namespace orca::bench {
namespace {

// A publisher with three subscribers, all on threads. The first is the sibling that is watched, the last one
// may be stuck.
class Group {
 public:
  Group(Executive& executive, bool one_is_stuck) : publisher_(executive), reached_(executive.make_event()) {
    for (const char* name : {"sibling", "other", "last"}) {
      subscribers_.push_back(std::make_unique<Subscriber>(executive, name));
      subscribe(publisher_, *subscribers_.back());
    }
    for (std::size_t i = 0; i < subscribers_.size(); ++i)
      scripts_.push_back(std::make_unique<test::Script>(
          *subscribers_[i],
          [this, i, stuck = one_is_stuck && i == 2] { stuck ? be_stuck(i) : take_all(i); }));
  }

  /// Of push().
  Nanoseconds publish() {
    Loan<Scan> scan = std::move(make_scans(1, kLaser).front());
    const Nanoseconds taken = time_per_operation(1, [&] { publisher_.out.push(std::move(scan)); });
    reached_->wait_until(kForever);
    return taken;
  }

  /// From push() until the sibling has the object.
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
  void be_stuck(std::size_t i) {
    subscribers_[i]->strand().wait_for(kForever, [] { return false; });
  }

  Publisher publisher_;
  std::unique_ptr<Event> reached_;
  std::vector<std::unique_ptr<Subscriber>> subscribers_;
  std::vector<std::unique_ptr<test::Script>> scripts_;
};

void compare(benchmark::State& state, Row& row, Nanoseconds (Group::*measured)()) {
  run_on(kThreads, [&](Executive& executive) {
    Group with_stuck(executive, true);
    Group healthy(executive, false);
    alternate(
        state, row, 1, [&](int) { return (with_stuck.*measured)(); },
        [&](int) { return (healthy.*measured)(); });
  });
}

}  // namespace

void register_isolation() {
  add_row({"push beside a stuck subscriber", "beside a healthy one", p99_ratio_at_most(1.05)}, 20000,
          [](auto& state, Row& row) { compare(state, row, &Group::publish); });
  add_row({"reaching the sibling of a stuck one", "of a healthy one", p99_ratio_at_most(1.05)}, 20000,
          [](auto& state, Row& row) { compare(state, row, &Group::reach_sibling); });
}

}  // namespace orca::bench
