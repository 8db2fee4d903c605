// SPDX-License-Identifier: GPL-3.0-or-later
// What the statistics say of inputs that have no answer, and of those whose answer is a convention.
#include <catch2/catch.hpp>

#include <limits>
#include <string>
#include <vector>

#include "orca/batch/statistics/bootstrap.hpp"
#include "orca/batch/statistics/holm.hpp"
#include "orca/batch/statistics/mcnemar.hpp"
#include "orca/batch/statistics/rate.hpp"
#include "orca/batch/statistics/verdict.hpp"
#include "orca/batch/statistics/wilcoxon.hpp"

using namespace orca;
using namespace orca::batch;
using Catch::Contains;

namespace {

using Nested = std::vector<std::vector<double>>;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();
const std::vector<double> kNone;
const std::vector<double> kTwo{1.0, 2.0};

template <class T>
std::string error_of(const Result<T>& result) {
  REQUIRE_FALSE(result);
  CHECK(result.error().code == Code::invalid_argument);
  return result.error().text();
}

Verdict verdict_of(const Comparison& comparison) { return judge(comparison).value(); }

}  // namespace

TEST_CASE("no values have no summary", "[batch][statistics]") {
  for (const auto& result : {mean(kNone), median(kNone), quantile(kNone, 0.1), interquartile_mean(kNone)})
    CHECK_THAT(error_of(result), Contains("there are no values; at least one is needed"));
}

TEST_CASE("values that are not finite or too large for sums are named by their place",
          "[batch][statistics]") {
  for (const double bad : {kNoNumber, kEndless, -kEndless, 1e301, -1e301}) {
    const std::vector<double> values{1.0, bad, 3.0};
    const std::string fault = "value 2 of 3 is not finite, or beyond 1e300";
    for (const auto& result :
         {mean(values), median(values), quantile(values, 0.1), interquartile_mean(values)})
      CHECK(error_of(result) == fault);
    CHECK(error_of(wilcoxon(values)) == fault);
    const Nested worlds{kTwo, values};
    const std::string placed = "world 2 of 2: " + fault;
    CHECK(error_of(world_means(worlds)) == placed);
    CHECK(error_of(bootstrap_mean(worlds)) == placed);
    CHECK(error_of(bootstrap_difference(worlds, worlds)) == placed);
    CHECK(error_of(probability_of_improvement(worlds, worlds)) == placed);
  }
}

TEST_CASE("differences are checked as values are", "[batch][statistics]") {
  constexpr double most = 1e300;
  CHECK_THAT(error_of(wilcoxon(std::vector{most}, std::vector{-most})),
             Contains("value 1 of 1 is not finite"));
  CHECK_THAT(error_of(paired_differences(Nested{{most}}, Nested{{-most}})),
             Contains("value 1 of 1 is not finite"));
}

TEST_CASE("a quantile needs a share", "[batch][statistics]") {
  for (const double q : {-0.1, 1.1, kNoNumber})
    CHECK_THAT(error_of(quantile(kTwo, q)), Contains("from 0 to 1"));
}

TEST_CASE("lists of different lengths are no pairs", "[batch][statistics]") {
  CHECK_THAT(error_of(wilcoxon(kTwo, std::vector{1.0})), Contains("the numbers of values differ: 2 and 1"));
  CHECK_THAT(error_of(paired_differences(Nested{kTwo}, Nested{kTwo, kTwo})),
             Contains("the numbers of worlds differ: 1 and 2"));
  CHECK_THAT(error_of(bootstrap_difference(Nested{kTwo, kTwo}, Nested{kTwo, {1.0}})),
             Contains("world 2: the numbers of values differ: 2 and 1"));
  CHECK_THAT(error_of(probability_of_improvement(Nested{kTwo}, Nested{})),
             Contains("the numbers of worlds differ: 1 and 0"));
}

TEST_CASE("no worlds and worlds without runs are refused", "[batch][statistics]") {
  CHECK_THAT(error_of(bootstrap_mean(Nested{})), Contains("there are no worlds"));
  CHECK_THAT(error_of(bootstrap_mean(Nested{kTwo, {}})), Contains("world 2 of 2: there are no values"));
  CHECK_THAT(error_of(world_means(Nested{})), Contains("there are no worlds"));
  CHECK_THAT(error_of(paired_differences(Nested{{}}, Nested{{}})),
             Contains("world 1 of 1: there are no values"));
  CHECK_THAT(error_of(probability_of_improvement(Nested{}, Nested{})), Contains("there are no worlds"));
  CHECK_THAT(error_of(bootstrap_mean(Nested{kTwo}, {.draws = 0})), Contains("at least one draw"));
}

TEST_CASE("a rate needs runs, and no more successes than runs", "[batch][statistics]") {
  CHECK_THAT(error_of(wilson_interval(0, 0)), Contains("there are no runs"));
  CHECK_THAT(error_of(wilson_interval(3, 2)), Contains("3 successes in 2 runs"));
  CHECK(wilson_interval(0, 1).value().low == 0.0);
  CHECK(wilson_interval(1, 1).value().high == 1.0);
}

TEST_CASE("tests without pairs are refused, and without a difference p is 1", "[batch][statistics]") {
  CHECK_THAT(error_of(mcnemar(std::vector<SuccessPair>{})), Contains("there are no pairs"));
  CHECK(mcnemar(std::vector<SuccessPair>{{true, true}, {false, false}}).value().p == 1.0);
  CHECK(mcnemar(0, 0).p == 1.0);
  CHECK_THAT(error_of(wilcoxon(kNone)), Contains("there are no values"));
  CHECK_THAT(error_of(wilcoxon(kNone, kNone)), Contains("there are no values"));
  const Wilcoxon equal = wilcoxon(kTwo, kTwo).value();
  CHECK(equal.used == 0);
  CHECK(equal.p == 1.0);
  CHECK(wilcoxon(std::vector{0.5}).value().p == 1.0);
}

TEST_CASE("Holm's correction wants p-values", "[batch][statistics]") {
  CHECK(holm(kNone).value().empty());
  CHECK(holm(std::vector{0.02}).value() == std::vector{0.02});
  CHECK(holm(std::vector{1.0, 0.9, 0.0}).value() == std::vector{1.0, 1.0, 0.0});
  for (const double bad : {-0.01, 1.01, kNoNumber})
    CHECK_THAT(error_of(holm(std::vector{0.5, bad})), Contains("p-value 2 of 2 is not a number from 0 to 1"));
}

TEST_CASE("equal values give themselves, to the last bit, and an interval of zero width",
          "[batch][statistics]") {
  const Nested worlds{{0.1, 0.1, 0.1}, {0.1}, {0.1, 0.1}};
  const std::vector<double> values(7, 0.1);
  CHECK(mean(values).value() == 0.1);
  CHECK(interquartile_mean(values).value() == 0.1);
  CHECK(quantile(values, 0.3).value() == 0.1);
  const Estimate estimate = bootstrap_mean(worlds).value();
  CHECK(estimate.value == 0.1);
  CHECK(estimate.interval == Interval{0.1, 0.1});
  CHECK(bootstrap_difference(worlds, worlds).value().interval == Interval{0.0, 0.0});
  CHECK(probability_of_improvement(worlds, worlds).value() == 0.5);
}

TEST_CASE("one world is resampled by its seeds alone, and one value not at all", "[batch][statistics]") {
  const Interval seeds = bootstrap_mean(Nested{{1.0, 2.0, 3.0}}).value().interval;
  CHECK(seeds.low >= 1.0);
  CHECK(seeds.high <= 3.0);
  CHECK(seeds.low < 1.5);
  CHECK(seeds.high > 2.5);
  CHECK(bootstrap_mean(Nested{{4.0}}).value().interval == Interval{4.0, 4.0});
  CHECK(bootstrap_mean(Nested{{4.0, 5.0}}, {.draws = 1}).value().interval.low >= 4.0);
}

TEST_CASE("a world counts as often as it has runs", "[batch][statistics]") {
  CHECK(bootstrap_mean(Nested{{1.0}, {4.0, 4.0}}).value().value == 3.0);
  CHECK(world_means(Nested{{1.0}, {3.0, 5.0}}).value() == std::vector{1.0, 4.0});
}

TEST_CASE("a difference is established with 9 runs, a small p-value and an interval without 0",
          "[batch][statistics]") {
  const Verdict verdict = verdict_of({9, 9, 0.05, {0.001, 0.02}});
  CHECK(verdict.established());
  CHECK(verdict.text == "difference established");
  CHECK(verdict_of({500, 500, 0.0, {-0.02, -0.001}}).established());
}

TEST_CASE("a difference that is not established gives every reason", "[batch][statistics]") {
  const Verdict few = verdict_of({8, 9, 0.01, {0.001, 0.02}});
  CHECK(few.doubts == std::vector{Doubt::too_few_runs});
  CHECK(few.text == "not established: too few runs (8 and 9, at least 9 of each are needed)");
  CHECK_FALSE(verdict_of({9, 8, 0.01, {0.001, 0.02}}).established());
  const Verdict wide = verdict_of({9, 9, 0.01, {0.0, 0.02}});
  CHECK(wide.text == "not established: the interval of the difference includes 0 (0 to 0.02)");
  const Verdict chance = verdict_of({9, 9, 0.0512, {0.001, 0.02}});
  CHECK(chance.text == "not established: the adjusted p-value 0.0512 is above 0.05");
  const Verdict all = verdict_of({0, 0, 1.0, {-0.25, 0.1234}});
  CHECK(all.doubts.size() == 3);
  CHECK_THAT(all.text, Contains("(0 and 0, ") && Contains("; the interval") &&
                           Contains("(-0.25 to 0.123); ") && Contains("p-value 1 is above 0.05"));
}

TEST_CASE("a comparison without numbers has no verdict", "[batch][statistics]") {
  for (const double p : {-0.1, 1.1, kNoNumber})
    CHECK_THAT(error_of(judge({9, 9, p, {1, 2}})), Contains("p-value"));
  for (const Interval& interval : {Interval{2, 1}, Interval{kNoNumber, 1}, Interval{1, kEndless}})
    CHECK_THAT(error_of(judge({9, 9, 0.01, interval})), Contains("the lower one first"));
}
