// SPDX-License-Identifier: GPL-3.0-or-later
// What is claimed of algorithms whose truth is known, over 2,000 simulated experiments of each kind (a tenth of them outside the slow
// tests): ties are not called established in more than 5 %, and a small true difference is found.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/batch/statistics/verdict.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::batch;

namespace {

using Nested = std::vector<std::vector<double>>;

// Draws for many reports. The level of a test with drawn signs does not depend on their number.
constexpr FindingOptions kFewDraws{{.draws = 2000}, {.draws = 2000}};

struct Pairs {
  Nested first, second;
};

// A kind of experiment.
struct Kind {
  Quantity quantity;
  std::size_t worlds, seeds;
  bool interact;       // a world may suit one of the two, in all its seeds
  double advantage{};  // of the first one: [s], or a share of success
};

// Times differ between worlds by 10 s and between runs by 3 s; a world that suits one of the two makes 3 s.
void add_times(const Kind& kind, RandomStream& random, Pairs& pairs) {
  const double world = random.normal(60.0, 10.0);
  const double suits = kind.interact ? random.normal(0.0, 3.0) : 0.0;
  for (std::size_t s = 0; s < kind.seeds; ++s) {
    pairs.first.back().push_back(world + suits + random.normal(-kind.advantage, 3.0));
    pairs.second.back().push_back(world + random.normal(0.0, 3.0));
  }
}

// Worlds are passed in 50 to 100 % of the runs; one that suits one of the two adds and takes up to 25 %.
void add_successes(const Kind& kind, RandomStream& random, Pairs& pairs) {
  const double world = random.uniform(0.5 + 0.5 * kind.advantage, 1.0 - 0.5 * kind.advantage);
  const double suits =
      (kind.interact ? std::min(0.25, 1.0 - world - 0.5 * kind.advantage) : 0.0) * random.uniform(-1.0, 1.0);
  for (std::size_t s = 0; s < kind.seeds; ++s) {
    pairs.first.back().push_back(random.chance(world + suits + 0.5 * kind.advantage) ? 1.0 : 0.0);
    pairs.second.back().push_back(random.chance(world - suits - 0.5 * kind.advantage) ? 1.0 : 0.0);
  }
}

Pairs drawn_pairs(const Kind& kind, RandomStream& random) {
  Pairs pairs;
  for (std::size_t w = 0; w < kind.worlds; ++w) {
    pairs.first.emplace_back();
    pairs.second.emplace_back();
    (kind.quantity == Quantity::success ? add_successes : add_times)(kind, random, pairs);
  }
  return pairs;
}

Finding finding_in(const Kind& kind, RandomStream& random) {
  const Pairs pairs = drawn_pairs(kind, random);
  return find_difference(pairs.first, pairs.second, kind.quantity, {}, kFewDraws).value();
}

int established(const Kind& kind, int experiments) {
  RandomStream random(31, "true_ties_test", "experiments");
  int count = 0;
  for (int i = 0; i < experiments; ++i) {
    const Finding finding = finding_in(kind, random);
    count += judge(finding, finding.p).value().established() ? 1 : 0;
  }
  return count;
}

std::vector<Kind> all_ties() {
  std::vector<Kind> kinds;
  for (const Quantity quantity : {Quantity::number, Quantity::success})
    for (const std::size_t worlds : {1U, 2U, 3U, 5U, 6U, 10U, 20U, 100U})
      for (const std::size_t seeds : {1U, 3U, 10U})
        for (const bool interact : {false, true})
          if (worlds >= kFewestDrawnWorlds || !interact) kinds.push_back({quantity, worlds, seeds, interact});
  return kinds;
}

// Worlds drawn as whole, ends at 2.5 and 97.5 % of the means of the draws: the plain percentile interval.
bool plain_interval_excludes_zero(const std::vector<double>& differences, RandomStream& random) {
  std::vector<double> means;
  for (int draw = 0; draw < 2000; ++draw) {
    double sum = 0.0;
    for (std::size_t i = 0; i < differences.size(); ++i) sum += differences[random() % differences.size()];
    means.push_back(sum);
  }
  std::ranges::sort(means);
  return means[50] > 0.0 || means[1949] < 0.0;
}

// Wilcoxon's signed-rank test by the normal approximation, for differences without ties and zeros: the test that many reports of
// times use.
bool wilcoxon_rejects(std::vector<double> differences) {
  std::ranges::sort(differences, {}, [](double d) { return std::fabs(d); });
  const auto n = static_cast<double>(differences.size());
  double ranks = 0.0;
  for (std::size_t i = 0; i < differences.size(); ++i)
    ranks += differences[i] > 0.0 ? static_cast<double>(i + 1) : 0.0;
  const double z = (ranks - n * (n + 1.0) / 4.0) / std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0);
  return std::fabs(z) > 1.959963984540054;
}

}  // namespace

TEST_CASE("a true tie is called established in at most 5 % of the experiments, of whatever kind",
          "[batch][statistics]") {
  const int experiments = test::part_of(2000);
  const double expected = 0.05 * experiments;
  const double noise = 3.0 * std::sqrt(0.95 * expected);  // three standard deviations of the count
  int all = 0;
  for (const Kind& kind : all_ties()) {
    const int count = established(kind, experiments);
    CAPTURE(kind.quantity == Quantity::success, kind.worlds, kind.seeds, kind.interact, count);
    CHECK(count <= expected + noise);
    all += count;
  }
  CHECK(all <= expected * static_cast<double>(all_ties().size()));  // of all kinds together without any noise
}

TEST_CASE("a small true difference in 100 worlds with 5 seeds is found as often as by drawing worlds only",
          "[batch][statistics]") {
  const int experiments = test::part_of(2000);
  for (const Kind& kind : {Kind{Quantity::success, 100, 5, false, 0.05},
                           {Quantity::number, 100, 5, false, 0.38},
                           {Quantity::number, 100, 5, true, 0.8}}) {
    RandomStream random(32, "true_ties_test", "power");
    RandomStream draws(33, "true_ties_test", "draws");
    int found = 0;
    int by_worlds = 0;  // of plain percentiles, beside the permutation test or Wilcoxon's
    for (int i = 0; i < experiments; ++i) {
      const Pairs pairs = drawn_pairs(kind, random);
      const Finding finding =
          find_difference(pairs.first, pairs.second, kind.quantity, {}, kFewDraws).value();
      found += judge(finding, finding.p).value().established() ? 1 : 0;
      const std::vector<double> means =
          world_means(paired_differences(pairs.first, pairs.second).value()).value();
      const bool has_small_p =
          kind.quantity == Quantity::success ? finding.p <= 0.05 : wilcoxon_rejects(means);
      by_worlds += has_small_p && plain_interval_excludes_zero(means, draws) ? 1 : 0;
    }
    CAPTURE(kind.quantity == Quantity::success, kind.interact, found, by_worlds, experiments);
    CHECK(found >= by_worlds);
    CHECK(by_worlds > experiments / 5);
  }
}

TEST_CASE(
    "algorithms that differ by the margin are called equal, or not worse, in at most 5 % of the experiments",
    "[batch][statistics]") {
  const int experiments = test::part_of(2000);
  const double expected = 0.05 * experiments;
  for (const std::size_t worlds : {3U, 10U, 40U})
    for (const Claim claim : {Claim::not_worse, Claim::equal}) {
      RandomStream random(34, "true_ties_test", "margins");
      int count = 0;
      for (int i = 0; i < experiments; ++i) {
        const Pairs pairs = drawn_pairs({Quantity::number, worlds, 5, true, -2.0}, random);  // 2 s slower
        const Finding finding =
            find_difference(pairs.first, pairs.second, Quantity::number, {claim, 2.0}, kFewDraws).value();
        count += judge(finding, finding.p).value().established() ? 1 : 0;
      }
      CAPTURE(worlds, claim == Claim::equal, count);
      CHECK(count <= expected);  // the level is 2.5 %
    }
}

TEST_CASE("as many worlds as a report says show the claim in about 80 % of the experiments",
          "[batch][statistics]") {
  const int experiments = test::part_of(2000);
  const double noise = 4.0 * std::sqrt(0.8 * 0.2 / experiments);
  for (const Claim claim : {Claim::difference, Claim::not_worse, Claim::equal}) {
    Finding known;
    known.asked = {claim, 1.5};
    known.difference.value = 1.5;
    known.spread = std::sqrt(9.0 + 2.0 * 9.0 / 5.0);  // that of add_times() with 5 seeds
    const std::size_t worlds = known.values_needed().value();
    RandomStream random(35, "true_ties_test", "power");
    int count = 0;
    for (int i = 0; i < experiments; ++i) {
      const double advantage = claim == Claim::difference ? -1.5 : 0.0;
      const Pairs pairs = drawn_pairs({Quantity::number, worlds, 5, true, advantage}, random);
      const Finding finding =
          find_difference(pairs.first, pairs.second, Quantity::number, {claim, 1.5}, kFewDraws).value();
      count += judge(finding, finding.p).value().established() ? 1 : 0;
    }
    const double power = static_cast<double>(count) / experiments;
    CAPTURE(claim == Claim::equal, worlds, power);
    CHECK(power == Approx(0.8).epsilon(0.0).margin(noise));
  }
}
