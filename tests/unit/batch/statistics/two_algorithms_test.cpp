// SPDX-License-Identifier: GPL-3.0-or-later
// Whether verdicts are right about synthetic algorithms whose difference is known.
#include <catch2/catch.hpp>

#include "barn_like.hpp"
#include "orca/batch/statistics/verdict.hpp"

using namespace orca;
using namespace orca::batch;

namespace {

constexpr std::size_t kWorlds = 50;
constexpr std::size_t kSeeds = 10;  // 500 paired runs of each algorithm
constexpr double kShared = 0.7;     // of the luck of a pair
constexpr int kRepetitions = 200;

const Driver kBetter{};
const Driver kWorse{.success = -0.0208,
                    .slowness = 1.025};  // a score lower by 0.01, from both failures and time

std::vector<double> flat(const std::vector<std::vector<double>>& nested) {
  std::vector<double> values;
  for (const std::vector<double>& part : nested) values.insert(values.end(), part.begin(), part.end());
  return values;
}

// As a report with this one comparison does. Fewer draws are enough for many reports.
Verdict verdict_on(const Scores& scores, const FindingOptions& options = {{.draws = 1000}, {.draws = 2000}}) {
  const Finding finding = find_difference(scores.first, scores.second, Quantity::number, {}, options).value();
  return judge(finding, finding.p).value();
}

// Returns how many of the repetitions establish a difference.
int established(const Driver& first, const Driver& second, double shared) {
  RandomStream random(18, "two_algorithms_test", "runs");
  int count = 0;
  for (int i = 0; i < kRepetitions; ++i)
    count += verdict_on(drawn_scores(first, second, kWorlds, kSeeds, shared, random)).established() ? 1 : 0;
  return count;
}

// Scores of algorithms that are equal over all worlds: each is better in some worlds, with all seeds.
Scores drawn_specialists(RandomStream& random) {
  Scores scores{std::vector<std::vector<double>>(kWorlds), std::vector<std::vector<double>>(kWorlds)};
  for (std::size_t w = 0; w < kWorlds; ++w) {
    const double advantage = random.normal(0.0, 0.02);
    for (std::size_t s = 0; s < kSeeds; ++s) {
      scores.first[w].push_back(random.normal(0.2 + advantage, 0.02));
      scores.second[w].push_back(random.normal(0.2, 0.02));
    }
  }
  return scores;
}

}  // namespace

TEST_CASE("the synthetic algorithms differ by 0.01 in score", "[batch][statistics]") {
  RandomStream random(19, "two_algorithms_test", "runs");
  const Scores scores = drawn_scores(kBetter, kWorse, 200'000, 1, kShared, random);
  const double better = mean(flat(scores.first)).value();
  const double worse = mean(flat(scores.second)).value();
  CAPTURE(better, worse);
  CHECK(better > 0.2);
  CHECK(better < 0.25);
  CHECK(better - worse == Approx(0.01).margin(0.0005));  // four standard errors of the mean difference
}

TEST_CASE("algorithms that differ by 0.01 are told apart with 500 paired runs of each",
          "[batch][statistics]") {
  RandomStream random(18, "two_algorithms_test", "report");
  const Scores scores = drawn_scores(kBetter, kWorse, kWorlds, kSeeds, kShared, random);
  CHECK(verdict_on(scores, {}).established());
  const int found = established(kBetter, kWorse, kShared);
  CAPTURE(found);
  CHECK(found >= kRepetitions * 95 / 100);
}

TEST_CASE("equal algorithms are not told apart in at least 95 % of 200 repetitions", "[batch][statistics]") {
  const int found = established(kBetter, kBetter, kShared);
  CAPTURE(found);
  CHECK(found <= kRepetitions * 5 / 100);
}

TEST_CASE("fewer differences are found if the runs of a pair share no luck but their world",
          "[batch][statistics]") {
  const int found = established(kBetter, kWorse, 0.0);
  CAPTURE(found);
  CHECK(found < kRepetitions * 90 / 100);
  CHECK(found > kRepetitions * 50 / 100);
}

TEST_CASE("algorithms that are equal over all worlds are not told apart by the runs of one world",
          "[batch][statistics]") {
  RandomStream random(20, "two_algorithms_test", "specialists");
  int by_runs = 0;
  int verdicts = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    const Scores scores = drawn_specialists(random);
    const std::vector<double> differences = flat(paired_differences(scores.first, scores.second).value());
    by_runs += sign_flips(differences, {.draws = 2000}).value().p <= 0.05 ? 1 : 0;
    verdicts += verdict_on(scores).established() ? 1 : 0;
  }
  CAPTURE(by_runs, verdicts);
  CHECK(by_runs > kRepetitions * 20 / 100);  // the test takes 500 runs in 50 worlds as independent
  CHECK(verdicts <= 22);                     // 10 expected; four standard deviations more
}
