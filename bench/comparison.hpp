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

/// The measurements of one side of a comparison. Each is the mean of a few consecutive operations [ns].
class Samples {
 public:
  void add(Nanoseconds per_operation) { values_.push_back(per_operation); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] Nanoseconds median() const;
  /// Returns the median of the p99 of each thousand consecutive samples. A moment's disturbance by another
  /// program spoils one of them, not all.
  [[nodiscard]] Nanoseconds p99() const;

 private:
  std::vector<Nanoseconds> values_;
};

/// A row of the table: an operation of Orca and the barest reference that does the same.
struct Row {
  std::string name;
  std::string reference_name;  ///< Empty: no reference.
  /// The target to meet; nothing: none is set.
  struct Target {
    enum class Of { median_ratio, p99_ratio, median };  ///< The limit of the last one is in ns.
    Of of = Of::median_ratio;
    double limit = 0.0;
  };
  std::optional<Target> target{};
  Samples subject{};
  Samples reference{};

  /// Returns the ratio of the p99 if the target is about them, otherwise of the medians.
  [[nodiscard]] std::optional<double> ratio() const;
  [[nodiscard]] bool judges_p99() const { return target && target->of == Target::Of::p99_ratio; }
  [[nodiscard]] bool missed() const;
};

constexpr Row::Target ratio_at_most(double limit) { return {Row::Target::Of::median_ratio, limit}; }
constexpr Row::Target p99_ratio_at_most(double limit) { return {Row::Target::Of::p99_ratio, limit}; }
constexpr Row::Target median_at_most(Nanoseconds limit) { return {Row::Target::Of::median, limit}; }

/// Returns all rows of this run, in the order of their registration.
std::vector<Row*>& rows();

/// A function that runs `operations` operations and returns the time of one [ns].
using Side = std::function<Nanoseconds(int operations)>;

/// Measures subject and reference in turn, sample by sample, so that drift affects both.
void alternate(benchmark::State& state, Row& row, int operations, const Side& subject, const Side& reference);
/// Measures a row without a reference.
void measure(benchmark::State& state, Row& row, int operations, const Side& subject);

/// Registers a row with Google Benchmark.
/// @param samples  number of samples of each side.
void add_row(Row row, int samples, const std::function<void(benchmark::State&, Row&)>& run);

/// Returns the time that `body` takes per operation [ns].
template <class Body>
Nanoseconds time_per_operation(int operations, Body&& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
  return taken.count() / operations;
}

}  // namespace orca::bench
