// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of intervals and tests: how often they are right, and what changes them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <thread>

#include "barn_like.hpp"
#include "orca/batch/statistics/finding.hpp"
#include "orca/batch/statistics/rate.hpp"

using namespace orca;
using namespace orca::batch;

namespace {

RandomStream stream(const char* name) { return {1, "coverage_test", name}; }

// Returns the share of 20,000 simulated experiments whose interval contains the rate.
double wilson_coverage(double rate, std::uint64_t runs) {
  RandomStream random = stream("wilson");
  int hits = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::uint64_t successes = 0;
    for (std::uint64_t k = 0; k < runs; ++k) successes += random.chance(rate) ? 1 : 0;
    hits += wilson_interval(successes, runs).value().contains(rate) ? 1 : 0;
  }
  return hits / 20'000.0;
}

std::vector<double> drawn_values(std::size_t count, RandomStream& random) {
  std::vector<double> values(count);
  for (double& value : values) value = random.normal(0.0, 1.0);
  return values;
}

// Returns the share of 1,000 simulated experiments whose interval contains the mean.
double mean_coverage(std::size_t count) {
  RandomStream random = stream("bootstrap");
  int hits = 0;
  for (int i = 0; i < 1000; ++i)
    hits +=
        estimate_mean(drawn_values(count, random), {.draws = 1000}).value().interval.contains(0.0) ? 1 : 0;
  return hits / 1000.0;
}

// The interval of a mean by a bootstrap that was written for this test: with std::mt19937 and plain loops.
Interval reference_interval(const std::vector<double>& values, double q) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::size_t> index(0, values.size() - 1);
  std::vector<double> means;
  for (int draw = 0; draw < 20'000; ++draw) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[index(random)];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  std::ranges::sort(means);
  const auto at = [&](double share) { return means[static_cast<std::size_t>(share * 20'000.0)]; };
  return {at(q), at(1.0 - q)};
}

// The p-value of a permutation test, by its definition.
double reference_p(const std::vector<double>& differences) {
  const double sum = std::accumulate(differences.begin(), differences.end(), 0.0);
  int as_far = 0;
  const int choices = 1 << differences.size();
  for (int signs = 0; signs < choices; ++signs) {
    double flipped = 0.0;
    for (std::size_t i = 0; i < differences.size(); ++i)
      flipped += (signs >> i) % 2 == 0 ? differences[i] : -differences[i];
    as_far += std::fabs(flipped) >= std::fabs(sum) - 1e-9 ? 1 : 0;
  }
  return static_cast<double>(as_far) / choices;
}

// Returns the share of 10,000 simulated experiments with equal algorithms in which p <= 0.05.
template <class Test>
double false_findings(const char* name, Test p_of_drawn) {
  RandomStream random = stream(name);
  int found = 0;
  for (int i = 0; i < 10'000; ++i) found += p_of_drawn(random) <= 0.05 ? 1 : 0;
  return found / 10'000.0;
}

// Four standard errors of a share of 0.05 among 10,000.
constexpr double kMargin = 4.0 * 0.00218;

std::vector<double> swapped(std::vector<double> differences) {
  for (double& difference : differences) difference = -difference;
  return differences;
}

}  // namespace

TEST_CASE("Wilson's interval contains the rate in about 95 % of 20,000 experiments", "[batch][statistics]") {
  for (const double rate : {0.5, 0.8, 0.9, 0.95, 0.99})
    for (const std::uint64_t runs : {10U, 50U, 200U}) {
      const double coverage = wilson_coverage(rate, runs);
      CAPTURE(rate, runs, coverage);
      CHECK(coverage > 0.896);  // least is 0.99^10, for 0.99 and 10 runs; less four standard errors
    }
}

TEST_CASE("an interval contains the mean in about 95 % of 1,000 experiments, of few values and of many",
          "[batch][statistics]") {
  for (const std::size_t count : {3U, 9U, 10U, 20U, 100U}) {
    const double coverage = mean_coverage(count);
    CAPTURE(count, coverage);
    CHECK(coverage == Approx(0.95).margin(0.028));  // four standard errors of a share of 1,000
  }
}

TEST_CASE("bootstrap and permutation test agree with others that were written for this test",
          "[batch][statistics]") {
  RandomStream random = stream("reference");
  for (const std::size_t count : {10U, 14U}) {
    const std::vector<double> values = drawn_values(count, random);
    CHECK(sign_flips(values).value().p == reference_p(values));
    const Interval ours = estimate_mean(values, {.draws = 100'000}).value().interval;
    const double n = static_cast<double>(count);
    // 2.2621571627982053 and 2.1603686564627926 are scipy.stats.t.ppf(0.975, count - 1).
    const double reach = count == 10 ? 2.2621571627982053 : 2.1603686564627926;
    const double q = 0.5 * std::erfc(reach * std::sqrt(n / (n - 1.0)) / std::sqrt(2.0));
    const Interval reference = reference_interval(values, q);
    const double margin =
        0.05 * (ours.high - ours.low);  // of 200 means beyond each end: four standard errors
    CHECK(ours.low == Approx(reference.low).epsilon(0.0).margin(margin));
    CHECK(ours.high == Approx(reference.high).epsilon(0.0).margin(margin));
  }
}

TEST_CASE("equal algorithms have p <= 0.05 in at most 5 % of 10,000 experiments", "[batch][statistics]") {
  constexpr SignFlipOptions kThousand{.draws = 1000};
  for (const std::size_t count : {6U, 9U, 25U}) {
    const double share = false_findings(
        "flips", [&](RandomStream& r) { return sign_flips(drawn_values(count, r), kThousand).value().p; });
    CAPTURE(count, share);
    CHECK(share <= 0.05 + kMargin);
  }
  for (const std::size_t count : {3U, 5U}) {
    const double share =
        false_findings("student", [&](RandomStream& r) { return student_p(drawn_values(count, r)).value(); });
    CAPTURE(count, share);
    CHECK(share <= 0.05 + kMargin);
  }
  const double share = false_findings("outcomes", [&](RandomStream& random) {
    std::vector<double> outcomes(30);
    for (double& outcome : outcomes) outcome = int{random.chance(0.7)} - int{random.chance(0.7)};
    return sign_flips(outcomes, kThousand).value().p;
  });
  CAPTURE(share);
  CHECK(share <= 0.05 + kMargin);
}

TEST_CASE("swapping the algorithms changes no p-value and turns intervals over", "[batch][statistics]") {
  RandomStream random = stream("swap");
  for (const std::size_t count : {4U, 8U, 25U, 60U}) {
    std::vector<double> differences = drawn_values(count, random);
    for (double& difference : differences) difference += 0.3;
    CHECK(sign_flips(differences).value().p == sign_flips(swapped(differences)).value().p);
    CHECK(student_p(differences).value() == student_p(swapped(differences)).value());
  }
  const Scores scores = drawn_scores({}, {.slowness = 1.1}, 20, 4, 0.7, random);
  const Estimate one = find_difference(scores.first, scores.second, Quantity::number).value().difference;
  const Estimate other = find_difference(scores.second, scores.first, Quantity::number).value().difference;
  CHECK(one.value == Approx(-other.value).epsilon(1e-12));
  CHECK(one.interval.low == Approx(-other.interval.high).epsilon(1e-12));
  CHECK(one.interval.high == Approx(-other.interval.low).epsilon(1e-12));
  CHECK(probability_of_improvement(scores.first, scores.second).value() ==
        Approx(1.0 - probability_of_improvement(scores.second, scores.first).value()).epsilon(1e-12));
}

TEST_CASE("the order of worlds changes no exact test and no summary", "[batch][statistics]") {
  RandomStream random = stream("order");
  std::vector<double> values(16);
  for (double& value : values) value = std::floor(random.normal(1.0, 4.0));
  std::vector<double> turned = values;
  std::ranges::reverse(turned);
  CHECK(sign_flips(values).value().p == sign_flips(turned).value().p);
  CHECK(interquartile_mean(values).value() == interquartile_mean(turned).value());
  CHECK(quantile(values, 0.3).value() == quantile(turned, 0.3).value());
}

TEST_CASE("the order of worlds changes a bootstrap interval by no more than other draws do",
          "[batch][statistics]") {
  RandomStream random = stream("worlds");
  std::vector<double> values = drawn_values(30, random);
  const Interval interval = estimate_mean(values).value().interval;
  std::ranges::reverse(values);
  const Interval turned = estimate_mean(values).value().interval;
  const double margin =
      0.05 * (interval.high - interval.low);  // of a difference of quantiles: four standard errors
  CHECK(std::fabs(turned.low - interval.low) < margin);
  CHECK(std::fabs(turned.high - interval.high) < margin);
}

TEST_CASE("the same seed gives the same interval, in any thread, and another seed another one",
          "[batch][statistics]") {
  RandomStream random = stream("seed");
  const std::vector<double> values = drawn_values(20, random);
  const Interval here = estimate_mean(values, {.seed = 7}).value().interval;
  Interval there[2];
  {
    std::jthread one([&] { there[0] = estimate_mean(values, {.seed = 7}).value().interval; });
    std::jthread two([&] { there[1] = estimate_mean(values, {.seed = 7}).value().interval; });
  }
  CHECK(there[0] == here);
  CHECK(there[1] == here);
  CHECK_FALSE(estimate_mean(values, {.seed = 8}).value().interval == here);
}

TEST_CASE("the finding in 100 worlds has always the same bits", "[batch][statistics]") {
  RandomStream random = stream("bits");
  const std::vector<double> values = drawn_values(100, random);
  const Interval interval = estimate_mean(values).value().interval;
  CHECK(interval.low == -0x1.f122d342d9154p-5);
  CHECK(interval.high == 0x1.72f325719b47bp-2);
  CHECK(sign_flips(values).value().p == 0x1.4b18cb191efbcp-3);
}
