// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one push to many components on the same executor, until all of them have taken the object, per
// subscriber.
#include <memory>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "scans.hpp"

namespace orca::bench {
namespace {

// A component that takes every object.
struct Taker : Subscriber {
  using Subscriber::Subscriber;
  void take_all() {
    for (;;) benchmark::DoNotOptimize(in.get_update_wait());
  }
};

class FanOut {
 public:
  FanOut(Executive& executive, int subscribers)
      : publisher_(executive),
        all_done_(executive.make_event()),
        last_turn_(executive.make_event()),
        last_(executive.spawn({"last", 0}, [this] {
          while (!ending_) {
            last_turn_->wait_until(kForever);
            all_done_->notify();
          }
        })) {
    for (int i = 0; i < subscribers; ++i) {
      takers_.push_back(std::make_unique<Taker>(executive, "taker" + std::to_string(i)));
      subscribe(publisher_, *takers_.back());
      Taker& taker = *takers_.back();
      scripts_.push_back(std::make_unique<test::Script>(taker, [&taker] { taker.take_all(); }));
    }
  }
  ~FanOut() {
    ending_ = true;
    last_turn_->notify();
  }

  Nanoseconds time(int pushes) {
    std::vector<Loan<Scan>> scans = make_scans(pushes, kLaser);
    return time_per_operation(pushes * static_cast<int>(takers_.size()), [&] {
      for (Loan<Scan>& scan : scans) {
        publisher_.out.push(std::move(scan));
        last_turn_->notify();  // runs after all takers, which are ready before it
        all_done_->wait_until(kForever);
      }
    });
  }

 private:
  Publisher publisher_;
  std::unique_ptr<Event> all_done_;
  std::unique_ptr<Event> last_turn_;
  bool ending_ = false;
  std::unique_ptr<Task> last_;
  std::vector<std::unique_ptr<Taker>> takers_;
  std::vector<std::unique_ptr<test::Script>> scripts_;
};

void beside_one(benchmark::State& state, Row& row, int subscribers) {
  run_on(kFibers, [&](Executive& executive) {
    FanOut many(executive, subscribers);
    FanOut one(executive, 1);
    alternate(
        state, row, subscribers < 100 ? 20 : 4, [&](int n) { return many.time(n); },
        [&](int /*n*/) { return one.time(20); });
  });
}

}  // namespace

void register_fan_out() {
  for (const int subscribers : {10, 100, 1000}) {
    add_row({"fan-out to " + std::to_string(subscribers) + ", per subscriber", "fan-out to 1",
             ratio_at_most(1.1)},
            subscribers < 1000 ? 1000 : 300,
            [subscribers](auto& state, Row& row) { beside_one(state, row, subscribers); });
  }
}

}  // namespace orca::bench
