// SPDX-License-Identifier: GPL-3.0-or-later
// Time per scan through a queue: taken from the pool, filled, pushed, received, and returned to the pool.
#include <algorithm>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "scans.hpp"

namespace orca::bench {
namespace {

class Stream {
 public:
  explicit Stream(Executive& executive) : publisher_(executive), subscriber_(executive) {
    subscribe(publisher_, subscriber_, {.depth = 64});
  }

  Nanoseconds time(int scans) {
    return time_per_operation(scans, [&] {
      for (int sent = 0; sent < scans;) {
        for (const int end = std::min(scans, sent + 64); sent < end; ++sent) push_one();
        while (subscriber_.in.new_data_arrived()) benchmark::DoNotOptimize(subscriber_.in.get_update());
      }
    });
  }

  [[nodiscard]] const std::vector<double>& source() const { return source_; }

 private:
  void push_one() {
    Loan<Scan> scan = publisher_.out.loan();
    scan->ranges() = source_;
    publisher_.out.push(std::move(scan));
  }

  Publisher publisher_;
  Subscriber subscriber_;
  std::vector<double> source_ = std::vector<double>(kLaser, 1.0);
};

Nanoseconds copy(const std::vector<double>& from, int times) {
  std::vector<double> to(from.size());
  return time_per_operation(times, [&] {
    for (int i = 0; i < times; ++i) {
      to = from;
      benchmark::DoNotOptimize(to.data());
      benchmark::ClobberMemory();
    }
  });
}

void run(benchmark::State& state, Row& row) {
  run_on(kFibers, [&](Executive& executive) {
    Stream stream(executive);
    alternate(
        state, row, 640, [&](int n) { return stream.time(n); },
        [&](int n) { return copy(stream.source(), n); });
  });
}

}  // namespace

void register_throughput() {
  add_row({"a 3 KB scan made, pushed, taken (queue of 64)", "memcpy of 3 KB"}, 500, run);
}

}  // namespace orca::bench
