// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace orca::bench {

using Nanoseconds = double;

/// Measurements of one thing: each the mean of a few operations that followed each other [ns].
class Samples {
 public:
  void add(Nanoseconds per_operation) { values_.push_back(per_operation); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] Nanoseconds median() const;
  /// The median of the p99 of each thousand samples in a row: what another program does to this one for a
  /// moment spoils one of them, not all.
  [[nodiscard]] Nanoseconds p99() const;

 private:
  std::vector<Nanoseconds> values_;
};

/// One row of the table: something of Orca's beside the barest thing that does the like.
struct Row {
  std::string name;
  std::string reference_name;  ///< Empty: nothing to compare with.
  /// What is good enough; nothing: not judged.
  struct Target {
    enum class Of { median_ratio, p99_ratio, median };  ///< The last one in ns.
    Of of = Of::median_ratio;
    double limit = 0.0;
  };
  std::optional<Target> target{};
  Samples subject{};
  Samples reference{};

  /// Of the p99 where the target is about them, otherwise of the medians.
  [[nodiscard]] std::optional<double> ratio() const;
  [[nodiscard]] bool judges_p99() const { return target && target->of == Target::Of::p99_ratio; }
  [[nodiscard]] bool missed() const;
};

constexpr Row::Target ratio_at_most(double limit) { return {Row::Target::Of::median_ratio, limit}; }
constexpr Row::Target p99_ratio_at_most(double limit) { return {Row::Target::Of::p99_ratio, limit}; }
constexpr Row::Target median_at_most(Nanoseconds limit) { return {Row::Target::Of::median, limit}; }

/// All rows of this run, in the order in which they were registered.
std::vector<Row*>& rows();

/// Runs `operations` operations and returns how long one took [ns].
using Side = std::function<Nanoseconds(int operations)>;

/// Measures subject and reference in turn, sample by sample, so that what drifts meets both.
void alternate(benchmark::State& state, Row& row, int operations, const Side& subject, const Side& reference);
/// Without a reference.
void measure(benchmark::State& state, Row& row, int operations, const Side& subject);

/// Registers a row with Google Benchmark.
/// @param samples  how many of each side.
void add_row(Row row, int samples, const std::function<void(benchmark::State&, Row&)>& run);

/// How long `body` takes, per operation [ns].
template <class Body>
Nanoseconds time_per_operation(int operations, Body&& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
  return taken.count() / operations;
}

}  // namespace orca::bench
