// SPDX-License-Identifier: GPL-3.0-or-later
// Values of SciPy 1.10.1 and NumPy 1.24.2. The comment above each gives the call that made them.
#include <catch2/catch.hpp>

#include <cmath>
#include <tuple>
#include <vector>

#include "normal.hpp"
#include "orca/batch/statistics/bootstrap.hpp"
#include "orca/batch/statistics/holm.hpp"
#include "orca/batch/statistics/mcnemar.hpp"
#include "orca/batch/statistics/rate.hpp"
#include "orca/batch/statistics/summary.hpp"
#include "orca/batch/statistics/wilcoxon.hpp"

using namespace orca;
using namespace orca::batch;

namespace {

// Relative, with nothing added for small values.
Approx close_to(double value, double relative = 1e-12) {
  return Approx(value).epsilon(relative).margin(0.0).scale(0.0);
}

const std::vector<double> kScores{0.21, 0.18, 0.25, 0.0, 0.17, 0.22, 0.19, 0.24, 0.2, 0.23, 0.05};

std::span<const double> first_scores(std::size_t count) { return std::span(kScores).first(count); }

}  // namespace

TEST_CASE("the complementary error function has a relative error below 1e-13", "[batch][statistics]") {
  // scipy.special.erfc(x)
  for (const auto& [x, value] : std::vector<std::pair<double, double>>{{0.0, 1.0},
                                                                       {1e-8, 0.9999999887162083},
                                                                       {0.1, 0.8875370839817152},
                                                                       {0.5, 0.4795001221869535},
                                                                       {1.0, 0.15729920705028516},
                                                                       {1.4999999, 0.03389486541771998},
                                                                       {1.5, 0.03389485352468927},
                                                                       {2.0, 0.004677734981047266},
                                                                       {3.0, 2.2090496998585445e-05},
                                                                       {5.0, 1.5374597944280347e-12},
                                                                       {10.0, 2.0884875837625446e-45},
                                                                       {20.0, 5.395865611607901e-176},
                                                                       {26.0, 5.663192408856145e-296}})
    CHECK(erfc_of_positive(x) == close_to(value, 1e-13));
  for (double x = 0.0; x < 26.0; x += 0.001) {
    const long double right = std::erfc(static_cast<long double>(x));
    REQUIRE(std::fabs(static_cast<double>((erfc_of_positive(x) - right) / right)) < 1e-13);
  }
}

TEST_CASE("Wilson's interval is SciPy's", "[batch][statistics]") {
  // scipy.stats.binomtest(successes, runs).proportion_ci(0.95, method="wilson")
  for (const auto& [successes, runs, low, high] :
       std::vector<std::tuple<std::uint64_t, std::uint64_t, double, double>>{
           {0, 10, 0.0, 0.27753279986288926},
           {10, 10, 0.7224672001371109, 1.0},
           {1, 10, 0.017876213095072896, 0.4041500267952385},
           {8, 10, 0.4901624715366418, 0.9433178485456248},
           {81, 263, 0.2552885198782742, 0.36620957698280004},
           {450, 500, 0.8705780903680599, 0.9233224372626984},
           {95'000, 100'000, 0.9486318174896534, 0.9513336107090217}}) {
    const Interval interval = wilson_interval(successes, runs).value();
    CHECK(interval.low == close_to(low));
    CHECK(interval.high == close_to(high));
  }
}

TEST_CASE("McNemar's exact p-values are SciPy's", "[batch][statistics]") {
  // scipy.stats.binomtest(only_first, only_first + only_second).pvalue
  for (const auto& [only_first, only_second, p] :
       std::vector<std::tuple<std::uint64_t, std::uint64_t, double>>{{1, 0, 1.0},
                                                                     {0, 5, 0.0625},
                                                                     {0, 6, 0.03125},
                                                                     {3, 9, 0.14599609375},
                                                                     {9, 3, 0.14599609375},
                                                                     {5, 5, 1.0},
                                                                     {10, 25, 0.016673847800120715},
                                                                     {480, 520, 0.2174482932041409},
                                                                     {0, 900, 2.3661043723335494e-271}})
    CHECK(mcnemar(only_first, only_second).p == close_to(p));
}

TEST_CASE("McNemar's p-values of many pairs and small probabilities have an error below 1e-13",
          "[batch][statistics]") {
  // With n = only_first + only_second and Python's fractions, because SciPy is off by 6e-13 in the last case:
  // float(Fraction(2 * sum(math.comb(n, k) for k in range(min(only_first, only_second) + 1)), 2**n))
  CHECK(mcnemar(121, 59).p == close_to(4.434449263755176e-06, 1e-13));
  CHECK(mcnemar(100, 300).p == close_to(2.5918869069720767e-24, 1e-13));
  CHECK(mcnemar(49'000, 51'000).p == close_to(2.588716038346898e-10, 1e-13));
  CHECK(mcnemar(498'000, 502'000).p == close_to(6.360933750082489e-05, 1e-13));
}

TEST_CASE("McNemar's test counts the pairs of which one succeeded", "[batch][statistics]") {
  const std::vector<SuccessPair> pairs{
      {true, true}, {true, false}, {false, true}, {true, false}, {false, false}};
  const McNemar result = mcnemar(pairs).value();
  CHECK(result.only_first == 2);
  CHECK(result.only_second == 1);
  CHECK(result.p == 1.0);
}

TEST_CASE("Wilcoxon's exact p-values are SciPy's", "[batch][statistics]") {
  // scipy.stats.wilcoxon(differences, zero_method="wilcox", correction=False, alternative="two-sided", method="exact")
  const Wilcoxon ten = wilcoxon(std::vector<double>{7, -1, 12, 3, -4, 9, 15, -2, 6, 11}).value();
  CHECK(ten.exact);
  CHECK(ten.used == 10);
  CHECK(ten.negative_ranks == 7.0);
  CHECK(ten.positive_ranks == 48.0);
  CHECK(ten.p == close_to(0.037109375));
  // Darwin's plants, from Fisher, "The design of experiments", 1935, table 3.
  const Wilcoxon darwin =
      wilcoxon(std::vector<double>{6, 8, 14, 16, 23, 24, 28, 29, 41, -48, 49, 56, 60, -67, 75}).value();
  CHECK(darwin.negative_ranks == 24.0);
  CHECK(darwin.p == close_to(0.041259765625));
  std::vector<double> mixed;  // [(-1)**(i * i // 3) * i for i in range(1, 26)]
  for (int i = 1; i <= 25; ++i) mixed.push_back((i * i / 3) % 2 == 0 ? i : -i);
  CHECK(wilcoxon(mixed).value().exact);
  CHECK(wilcoxon(mixed).value().p == close_to(0.6338268518447876));
  std::vector<double> rising;  // numpy.arange(1.0, 26)
  for (int i = 1; i <= 25; ++i) rising.push_back(i);
  CHECK(wilcoxon(rising).value().p == close_to(5.960464477539063e-08));
}

TEST_CASE("Wilcoxon's approximate p-values are SciPy's", "[batch][statistics]") {
  // scipy.stats.wilcoxon(differences, zero_method="wilcox", correction=False, alternative="two-sided", method="approx")
  const Wilcoxon ties = wilcoxon(std::vector<double>{3, -1, 3, 2, -2, 5, 5, 5, -1, 4}).value();
  CHECK_FALSE(ties.exact);
  CHECK(ties.negative_ranks == 6.5);
  CHECK(ties.p == close_to(0.03153033220756929));
  const Wilcoxon zeros = wilcoxon(std::vector<double>{7, -1, 12, 0, 3, -4, 9, 15, -2, 6, 11, 0}).value();
  CHECK_FALSE(zeros.exact);
  CHECK(zeros.used == 10);
  CHECK(zeros.p == close_to(0.03665792867221451));
  std::vector<double> forty;  // [((i * 37) % 41) - 14.5 for i in range(40)]
  for (int i = 0; i < 40; ++i) forty.push_back((i * 37) % 41 - 14.5);
  CHECK(wilcoxon(forty).value().p == close_to(0.006352385214212849));
  std::vector<double> many;  // [((i * 7919) % 1009) - 480.0 for i in range(500)], with ties and one zero
  for (int i = 0; i < 500; ++i) many.push_back((i * 7919) % 1009 - 480.0);
  CHECK(wilcoxon(many).value().p == close_to(0.07570295747559605));
}

TEST_CASE("Holm's adjusted p-values come in the order given", "[batch][statistics]") {
  // o = numpy.argsort(p, kind="stable"); a[o] = numpy.minimum(1, numpy.maximum.accumulate(p[o] * numpy.arange(len(p), 0, -1)))
  const std::vector<double> adjusted = holm(std::vector<double>{0.01, 0.04, 0.03, 0.005, 0.2, 0.04}).value();
  const std::vector<double> expected{0.05, 0.12, 0.12, 0.03, 0.2, 0.12};
  REQUIRE(adjusted.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(adjusted[i] == close_to(expected[i]));
}

TEST_CASE("mean, median and quantiles are NumPy's", "[batch][statistics]") {
  CHECK(mean(kScores).value() == close_to(0.17636363636363636));             // numpy.mean(v)
  CHECK(median(kScores).value() == close_to(0.2));                           // numpy.median(v)
  CHECK(median(first_scores(10)).value() == close_to(0.20500000000000002));  // numpy.median(v[:10])
  // numpy.quantile(v, q)
  for (const auto& [q, value] : std::vector<std::pair<double, double>>{{0.0, 0.0},
                                                                       {0.025, 0.0125},
                                                                       {0.1, 0.05},
                                                                       {0.25, 0.175},
                                                                       {0.5, 0.2},
                                                                       {0.9, 0.24},
                                                                       {0.975, 0.2475},
                                                                       {1.0, 0.25}})
    CHECK(quantile(kScores, q).value() == close_to(value));
}

TEST_CASE("the interquartile mean is SciPy's trimmed mean", "[batch][statistics]") {
  // scipy.stats.trim_mean(v[:n], 0.25)
  CHECK(interquartile_mean(first_scores(3)).value() == close_to(0.21333333333333335));
  CHECK(interquartile_mean(first_scores(4)).value() == close_to(0.195));
  CHECK(interquartile_mean(first_scores(8)).value() == close_to(0.19999999999999998));
  CHECK(interquartile_mean(kScores).value() == close_to(0.19999999999999998));
}

TEST_CASE("the probability of improvement is the mean of Mann and Whitney's shares over worlds",
          "[batch][statistics]") {
  const std::vector<std::vector<double>> first{{3, 5, 6}, {1, 2, 9, 9}, {0.5}};
  const std::vector<std::vector<double>> second{{4, 5}, {2, 2, 3, 1}, {0.5, 0.25, 0.125}};
  // numpy.mean([scipy.stats.mannwhitneyu(x, y).statistic / (len(x) * len(y)) for x, y in zip(first, second)])
  CHECK(probability_of_improvement(first, second).value() == close_to(0.6909722222222223));
}

TEST_CASE("bootstrap intervals are those of NumPy and SciPy, up to the draws", "[batch][statistics]") {
  std::vector<std::vector<double>> worlds(
      8);  // v = numpy.array([[0.01 * ((w * 7 + s * 5) % 23) for s in range(3)] for w in range(8)])
  std::vector<std::vector<double>> one_seed(8);
  for (int w = 0; w < 8; ++w) {
    for (int s = 0; s < 3; ++s) worlds[static_cast<std::size_t>(w)].push_back(0.01 * ((w * 7 + s * 5) % 23));
    one_seed[static_cast<std::size_t>(w)].push_back(worlds[static_cast<std::size_t>(w)][0]);
  }
  // r = numpy.random.default_rng(1); n = 1_000_000; w = r.integers(0, 8, (n, 8)); s = r.integers(0, 3, (n, 8, 3))
  // m = v[w[:, :, None], s].mean((1, 2)); numpy.quantile(m, [0.025, 0.975]), drawn in ten parts. The margin is four standard
  // errors of a quantile of 100,000 draws, 0.0084 times numpy.std(m).
  const Estimate nested = bootstrap_mean(worlds, {.draws = 100'000}).value();
  CHECK(nested.value == close_to(0.103333333333333));
  CHECK(nested.interval.low == Approx(0.072083333333333).epsilon(0.0).margin(4 * 0.0084 * 0.0163));
  CHECK(nested.interval.high == Approx(0.135833333333333).epsilon(0.0).margin(4 * 0.0084 * 0.0163));
  // scipy.stats.bootstrap((v[:, 0],), numpy.mean, n_resamples=1_000_000, method="percentile", random_state=1, batch=10000)
  const Estimate plain = bootstrap_mean(one_seed, {.draws = 100'000}).value();
  CHECK(plain.value == close_to(0.10125));
  CHECK(plain.interval.low == Approx(0.0525).epsilon(0.0).margin(4 * 0.0084 * 0.0252));
  CHECK(plain.interval.high == Approx(0.15125).epsilon(0.0).margin(4 * 0.0084 * 0.0252));
}
