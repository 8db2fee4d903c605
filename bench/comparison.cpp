// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison.hpp"

#include <algorithm>
#include <memory>
#include <span>

namespace orca::bench {

namespace {

constexpr std::size_t kBlock = 1000;

// Returns a quantile of the samples, which it reorders.
Nanoseconds quantile(std::span<Nanoseconds> samples, double share) {
  const auto place = static_cast<std::size_t>(share * static_cast<double>(samples.size() - 1));
  std::ranges::nth_element(samples, samples.begin() + static_cast<std::ptrdiff_t>(place));
  return samples[place];
}

}  // namespace

Nanoseconds Samples::median() const {
  std::vector<Nanoseconds> samples = values_;
  return quantile(samples, 0.5);
}

Nanoseconds Samples::p99() const {
  std::vector<Nanoseconds> samples = values_;
  std::vector<Nanoseconds> of_blocks;
  const std::span<Nanoseconds> all(samples);
  for (std::size_t start = 0; start < all.size(); start += kBlock)
    if (start == 0 || all.size() - start >= kBlock)
      of_blocks.push_back(quantile(all.subspan(start, std::min(kBlock, all.size() - start)), 0.99));
  return quantile(of_blocks, 0.5);
}

std::optional<double> Row::ratio() const {
  if (subject.empty() || reference.empty()) return std::nullopt;
  return judges_p99() ? subject.p99() / reference.p99() : subject.median() / reference.median();
}

bool Row::missed() const {
  if (!target) return false;
  if (target->of == Target::Of::median) return subject.median() > target->limit;
  return ratio() && *ratio() > target->limit;
}

std::vector<Row*>& rows() {
  static std::vector<Row*> all;
  return all;
}

void alternate(benchmark::State& state, Row& row, int operations, const Side& subject,
               const Side& reference) {
  subject(operations);  // warm-up
  reference(operations);
  // Each side goes first half of the time, so that each meets what the other leaves in the caches.
  bool first = true;
  for (auto _ : state) {
    if (!first) row.reference.add(reference(operations));
    const Nanoseconds taken = subject(operations);
    row.subject.add(taken);
    if (first) row.reference.add(reference(operations));
    first = !first;
    state.SetIterationTime(taken * 1e-9);
  }
}

void measure(benchmark::State& state, Row& row, int operations, const Side& subject) {
  subject(operations);  // warm-up
  for (auto _ : state) {
    const Nanoseconds taken = subject(operations);
    row.subject.add(taken);
    state.SetIterationTime(taken * 1e-9);
  }
}

void add_row(Row row, int samples, const std::function<void(benchmark::State&, Row&)>& run) {
  static std::vector<std::unique_ptr<Row>> owned;
  owned.push_back(std::make_unique<Row>(std::move(row)));
  Row& added = *owned.back();
  rows().push_back(&added);
  benchmark::RegisterBenchmark(added.name.c_str(),
                               [run, &added](benchmark::State& state) { run(state, added); })
      ->Iterations(samples)
      ->UseManualTime();
}

}  // namespace orca::bench
