// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of intervals and tests: how often they are right, and what changes them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <thread>

#include "barn_like.hpp"
#include "orca/batch/statistics/bootstrap.hpp"
#include "orca/batch/statistics/mcnemar.hpp"
#include "orca/batch/statistics/rate.hpp"
#include "orca/batch/statistics/wilcoxon.hpp"

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

// Values about 0 that differ between worlds as much as between the seeds of a world.
std::vector<std::vector<double>> drawn_worlds(std::size_t worlds, std::size_t seeds, RandomStream& random) {
  std::vector<std::vector<double>> values(worlds);
  for (std::vector<double>& world : values) {
    const double centre = random.normal(0.0, 1.0);
    for (std::size_t s = 0; s < seeds; ++s) world.push_back(random.normal(centre, 1.0));
  }
  return values;
}

// Returns the share of 1,000 simulated experiments whose interval contains the mean.
double bootstrap_coverage(std::size_t worlds, std::size_t seeds) {
  RandomStream random = stream("bootstrap");
  int hits = 0;
  for (int i = 0; i < 1000; ++i)
    hits +=
        bootstrap_mean(drawn_worlds(worlds, seeds, random), {.draws = 1000}).value().interval.contains(0.0)
            ? 1
            : 0;
  return hits / 1000.0;
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

double p_of_normal_differences(std::size_t pairs, RandomStream& random) {
  std::vector<double> differences(pairs);
  for (double& difference : differences) difference = random.normal(0.0, 1.0);
  return wilcoxon(differences).value().p;
}

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

TEST_CASE(
    "the bootstrap interval contains the mean in about 95 % of 1,000 experiments, and in fewer with 9 worlds",
    "[batch][statistics]") {
  const double few = bootstrap_coverage(9, 10);
  const double usual = bootstrap_coverage(50, 10);
  CAPTURE(few, usual);
  CHECK(few == Approx(0.911).margin(0.036));  // bootstrap.hpp says so; four standard errors
  CHECK(usual == Approx(0.95).margin(0.028));
}

TEST_CASE("the bootstrap interval knows that runs of one world resemble each other", "[batch][statistics]") {
  RandomStream random = stream("clusters");
  const std::vector<std::vector<double>> worlds = drawn_worlds(50, 10, random);
  std::vector<std::vector<double>> pretended;  // as if each run had a world of its own
  for (const std::vector<double>& world : worlds)
    for (const double value : world) pretended.push_back({value});
  const Interval honest = bootstrap_mean(worlds).value().interval;
  const Interval narrow = bootstrap_mean(pretended).value().interval;
  CHECK(honest.high - honest.low > 1.5 * (narrow.high - narrow.low));
}

TEST_CASE("equal algorithms have p <= 0.05 in at most 5 % of 10,000 experiments", "[batch][statistics]") {
  for (const std::size_t pairs : {6U, 9U, 25U, 26U, 100U}) {
    const double share =
        false_findings("wilcoxon", [&](RandomStream& r) { return p_of_normal_differences(pairs, r); });
    CAPTURE(pairs, share);
    CHECK(share <= 0.05 + kMargin);
  }
  for (const std::size_t pairs : {10U, 100U}) {
    const double share = false_findings("mcnemar", [&](RandomStream& random) {
      std::vector<SuccessPair> outcomes(pairs);
      for (SuccessPair& outcome : outcomes) outcome = {random.chance(0.7), random.chance(0.7)};
      return mcnemar(outcomes).value().p;
    });
    CAPTURE(pairs, share);
    CHECK(share <= 0.05);
  }
}

TEST_CASE("scores with many zeros and ties have p <= 0.05 in at most 5 % of 10,000 experiments",
          "[batch][statistics]") {
  const double share = false_findings("scores", [](RandomStream& random) {
    const Scores scores = drawn_scores({}, {}, 50, 1, 0.7, random);
    std::vector<double> first;
    std::vector<double> second;
    for (std::size_t w = 0; w < 50; ++w) {
      first.push_back(scores.first[w][0]);
      second.push_back(scores.second[w][0]);
    }
    return wilcoxon(first, second).value().p;
  });
  CAPTURE(share);
  CHECK(share <= 0.05 + kMargin);
}

TEST_CASE("the normal approximation rejects too often for 5 differences and a zero", "[batch][statistics]") {
  int found = 0;
  for (int signs = 0; signs < 32; ++signs) {
    std::vector<double> differences{0.0};
    for (int bit = 0; bit < 5; ++bit) differences.push_back((signs >> bit) % 2 == 0 ? bit + 1.0 : -bit - 1.0);
    found += wilcoxon(differences).value().p <= 0.05 ? 1 : 0;
  }
  CHECK(found == 2);  // 6.25 % of the 32 equally likely cases
}

TEST_CASE("swapping the algorithms changes no p-value and turns intervals over", "[batch][statistics]") {
  RandomStream random = stream("swap");
  for (const std::size_t pairs : {8U, 25U, 60U}) {
    std::vector<double> differences(pairs);
    for (double& difference : differences) difference = random.normal(0.3, 1.0);
    CHECK(wilcoxon(differences).value().p == wilcoxon(swapped(differences)).value().p);
  }
  CHECK(mcnemar(12, 31).p == mcnemar(31, 12).p);
  const Scores scores = drawn_scores({}, {.slowness = 1.1}, 20, 4, 0.7, random);
  const Estimate one = bootstrap_difference(scores.first, scores.second).value();
  const Estimate other = bootstrap_difference(scores.second, scores.first).value();
  CHECK(one.value == Approx(-other.value).epsilon(1e-12));
  CHECK(one.interval.low == Approx(-other.interval.high).epsilon(1e-12));
  CHECK(one.interval.high == Approx(-other.interval.low).epsilon(1e-12));
  CHECK(probability_of_improvement(scores.first, scores.second).value() ==
        Approx(1.0 - probability_of_improvement(scores.second, scores.first).value()).epsilon(1e-12));
}

TEST_CASE("the order of pairs changes neither tests nor summaries", "[batch][statistics]") {
  RandomStream random = stream("order");
  std::vector<double> values(24);
  for (double& value : values) value = std::floor(random.normal(1.0, 4.0));
  std::vector<double> turned = values;
  std::ranges::reverse(turned);
  CHECK(wilcoxon(values).value().p == wilcoxon(turned).value().p);
  CHECK(interquartile_mean(values).value() == interquartile_mean(turned).value());
  CHECK(quantile(values, 0.3).value() == quantile(turned, 0.3).value());
}

TEST_CASE("the order of worlds changes a bootstrap interval by no more than other draws do",
          "[batch][statistics]") {
  RandomStream random = stream("worlds");
  std::vector<std::vector<double>> worlds = drawn_worlds(30, 5, random);
  const Interval interval = bootstrap_mean(worlds).value().interval;
  std::ranges::reverse(worlds);
  const Interval turned = bootstrap_mean(worlds).value().interval;
  const double margin =
      0.04 * (interval.high - interval.low);  // of a difference of quantiles: four standard errors
  CHECK(std::fabs(turned.low - interval.low) < margin);
  CHECK(std::fabs(turned.high - interval.high) < margin);
}

TEST_CASE("the same seed gives the same interval, in any thread, and another seed another one",
          "[batch][statistics]") {
  RandomStream random = stream("seed");
  const std::vector<std::vector<double>> worlds = drawn_worlds(20, 3, random);
  const Interval here = bootstrap_mean(worlds, {.seed = 7}).value().interval;
  Interval there[2];
  {
    std::jthread one([&] { there[0] = bootstrap_mean(worlds, {.seed = 7}).value().interval; });
    std::jthread two([&] { there[1] = bootstrap_mean(worlds, {.seed = 7}).value().interval; });
  }
  CHECK(there[0] == here);
  CHECK(there[1] == here);
  CHECK_FALSE(bootstrap_mean(worlds, {.seed = 8}).value().interval == here);
}

TEST_CASE("a bootstrap of 100 worlds with 10 seeds and 10,000 draws has always the same bits",
          "[batch][statistics]") {
  RandomStream random = stream("bits");
  const Interval interval = bootstrap_mean(drawn_worlds(100, 10, random)).value().interval;
  CHECK(interval.low == -0x1.2fe0f04e33931p-3);
  CHECK(interval.high == 0x1.1f0aba6e8b0dcp-2);
}
