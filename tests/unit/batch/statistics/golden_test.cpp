// SPDX-License-Identifier: GPL-3.0-or-later
// Values of SciPy and NumPy: 1.17.1 and 2.4.6 of Student's t, of permutations and of the expanded bootstrap, 1.10.1 and 1.24.2 of the
// others. The comment above each gives the call that made them.
#include <catch2/catch.hpp>

#include <cmath>
#include <tuple>
#include <vector>

#include "normal.hpp"
#include "orca/batch/statistics/estimate.hpp"
#include "orca/batch/statistics/holm.hpp"
#include "orca/batch/statistics/paired_tests.hpp"
#include "orca/batch/statistics/rate.hpp"
#include "orca/batch/statistics/summary.hpp"
#include "student.hpp"

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

TEST_CASE("Student's tails and quantiles are SciPy's", "[batch][statistics]") {
  // 2 * scipy.stats.t.sf(abs(t), freedom)
  for (const auto& [t, freedom, tail] :
       std::vector<std::tuple<double, std::size_t, double>>{{0, 1, 1.0},
                                                            {1, 1, 0.5000000000000001},
                                                            {12.7, 1, 0.050024327689344165},
                                                            {0.5, 2, 0.6666666666666667},
                                                            {4.3, 2, 0.05005715411709159},
                                                            {2.5, 3, 0.08770664700806556},
                                                            {2.0, 4, 0.11611652351681556},
                                                            {-3.25, 9, 0.009997369084021572},
                                                            {1.7, 24, 0.10205659714111869},
                                                            {2.2, 99, 0.030132821689335863},
                                                            {1.96, 1000, 0.050273184955748736},
                                                            {2.6, 4999, 0.009349803305509968}})
    CHECK(two_sided_student_tail(t, freedom) == Approx(tail).epsilon(0.0).margin(1e-12));
  // scipy.stats.t.isf(tail / 2, freedom)
  for (const auto& [tail, freedom, t] :
       std::vector<std::tuple<double, std::size_t, double>>{{0.05, 1, 12.706204736174705},
                                                            {0.05, 2, 4.302652729749464},
                                                            {0.05, 3, 3.1824463052837086},
                                                            {0.05, 9, 2.2621571627982053},
                                                            {0.05, 99, 1.9842169515864176},
                                                            {0.05, 999, 1.9623414611334498},
                                                            {0.4, 2, 1.060660171779821},
                                                            {0.4, 30, 0.853767261471298},
                                                            {0.1, 19, 1.7291328115213687}})
    CHECK(student_reach(tail, freedom) == close_to(t));
}

TEST_CASE("Student's test and interval are SciPy's, and agree", "[batch][statistics]") {
  // x = scipy.stats.ttest_1samp(d, 0); x.pvalue, *x.confidence_interval()
  for (const auto& [differences, p, low, high] :
       std::vector<std::tuple<std::vector<double>, double, double, double>>{
           {{-1.5, -2.0, -0.5}, 0.09417837268432339, -3.2306248501317127, 0.5639581834650462},
           {{3, 1, 4, 1, 5}, 0.024896163460222765, 0.5788439158417651, 5.021156084158235},
           {{0.1, -0.2, 0.3, 0.25}, 0.3910022189557703, -0.24552520934441713, 0.4705252093444171}}) {
    const Interval interval = estimate_mean(differences).value().interval;
    CHECK(student_p(differences).value() == close_to(p));
    CHECK(interval.low == close_to(low));
    CHECK(interval.high == close_to(high));
    CHECK((p <= 0.05) != interval.contains(0.0));
  }
}

TEST_CASE("permutation tests are SciPy's", "[batch][statistics]") {
  // scipy.stats.permutation_test((d,), numpy.mean, permutation_type="samples", n_resamples=numpy.inf).pvalue
  const SignFlips ten = sign_flips(std::vector<double>{7, -1, 12, 3, -4, 9, 15, -2, 6, 11}).value();
  CHECK(ten.exact);
  CHECK(ten.used == 10);
  CHECK(ten.p == close_to(0.03125));
  // Darwin's plants, on which Fisher shows the test, "The design of experiments", 1935, section 21.
  CHECK(
      sign_flips(std::vector<double>{6, 8, 14, 16, 23, 24, 28, 29, 41, -48, 49, 56, 60, -67, 75}).value().p ==
      close_to(0.05267333984375));
  const SignFlips shares =
      sign_flips(std::vector<double>{0.2, -0.2, 0.4, 0, 0.6, 0.2, 0.2, -0.4, 0.8, 0.2, 0.2}).value();
  CHECK(shares.used == 10);
  CHECK(shares.p == close_to(0.111328125));
  CHECK(sign_flips(std::vector<double>(6, 0.1)).value().p == close_to(0.03125));
  // McNemar's test: scipy.stats.binomtest(3, 12).pvalue
  std::vector<double> outcomes(12, 1.0);
  for (int i = 0; i < 3; ++i) outcomes[static_cast<std::size_t>(4 * i)] = -1.0;
  CHECK(sign_flips(outcomes).value().p == close_to(0.14599609375));
}

TEST_CASE("a permutation test with drawn signs is SciPy's, up to the draws", "[batch][statistics]") {
  std::vector<double> forty;  // [((i * 37) % 41) - 14.5 for i in range(40)]
  for (int i = 0; i < 40; ++i) forty.push_back((i * 37) % 41 - 14.5);
  const SignFlips drawn = sign_flips(forty).value();
  CHECK_FALSE(drawn.exact);
  // as above, with n_resamples=2_000_000, random_state=1; four standard errors of a share of 100,000 draws
  CHECK(drawn.p == Approx(0.0035369982315008844).epsilon(0.0).margin(4 * 0.000188));
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

TEST_CASE("bootstrap intervals are those of NumPy, up to the draws", "[batch][statistics]") {
  std::vector<double> values;  // d = numpy.array([0.01 * ((w * 7) % 23) for w in range(12)])
  for (int w = 0; w < 12; ++w) values.push_back(0.01 * ((w * 7) % 23));
  // q = scipy.stats.norm.cdf(-scipy.stats.t.ppf(0.975, 11) * numpy.sqrt(12 / 11)), which is 0.010757
  // r = numpy.random.default_rng(1); m = d[r.integers(0, 12, (2_000_000, 12))].mean(1); numpy.quantile(m, [q, 1 - q]), drawn in
  // twenty parts. The margin is four standard errors of these quantiles of 100,000 draws.
  const Estimate estimate = estimate_mean(values, {.draws = 100'000}).value();
  CHECK(estimate.value == close_to(0.0975));
  CHECK(estimate.interval.low == Approx(0.05416666666666667).epsilon(0.0).margin(4 * 0.0002));
  CHECK(estimate.interval.high == Approx(0.1425).epsilon(0.0).margin(4 * 0.0002));
}
