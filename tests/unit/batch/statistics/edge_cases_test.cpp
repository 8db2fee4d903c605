// SPDX-License-Identifier: GPL-3.0-or-later
// What the statistics say of inputs that have no answer, and of those whose answer is a convention.
#include <catch2/catch.hpp>

#include <limits>
#include <string>
#include <vector>

#include "orca/batch/statistics/finding.hpp"
#include "orca/batch/statistics/holm.hpp"
#include "orca/batch/statistics/rate.hpp"
#include "orca/batch/statistics/verdict.hpp"

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

// What nine runs in twenty worlds found.
Finding finding_of(const Interval& interval, std::size_t runs = 9, std::size_t worlds = 20) {
  Finding finding;
  finding.runs = runs;
  finding.scope = {worlds};
  finding.difference = {0.5 * (interval.low + interval.high), interval};
  return finding;
}

Verdict verdict_of(const Finding& finding, double p) { return judge(finding, p).value(); }

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
    CHECK(error_of(sign_flips(values)) == fault);
    CHECK(error_of(student_p(values)) == fault);
    CHECK(error_of(estimate_mean(values)) == fault);
    CHECK(error_of(estimate_share(values, {0.0, 1.0})) == fault);
    const Nested worlds{kTwo, values};
    const std::string placed = "world 2 of 2: " + fault;
    CHECK(error_of(world_means(worlds)) == placed);
    CHECK(error_of(sample_of(worlds)) == placed);
    CHECK(error_of(find_difference(worlds, worlds, Quantity::number)) == placed);
    CHECK(error_of(probability_of_improvement(worlds, worlds)) == placed);
  }
}

TEST_CASE("differences are checked as values are", "[batch][statistics]") {
  constexpr double most = 1e300;
  CHECK_THAT(error_of(paired_differences(Nested{{most}}, Nested{{-most}})),
             Contains("value 1 of 1 is not finite"));
}

TEST_CASE("a quantile needs a share", "[batch][statistics]") {
  for (const double q : {-0.1, 1.1, kNoNumber})
    CHECK_THAT(error_of(quantile(kTwo, q)), Contains("from 0 to 1"));
}

TEST_CASE("lists of different lengths are no pairs", "[batch][statistics]") {
  CHECK_THAT(error_of(paired_differences(Nested{kTwo}, Nested{kTwo, kTwo})),
             Contains("the numbers of worlds differ: 1 and 2"));
  CHECK_THAT(error_of(find_difference(Nested{kTwo, kTwo}, Nested{kTwo, {1.0}}, Quantity::success)),
             Contains("world 2: the numbers of values differ: 2 and 1"));
  CHECK_THAT(error_of(probability_of_improvement(Nested{kTwo}, Nested{})),
             Contains("the numbers of worlds differ: 1 and 0"));
}

TEST_CASE("no worlds and worlds without runs are refused", "[batch][statistics]") {
  CHECK_THAT(error_of(sample_of(Nested{})), Contains("there are no worlds"));
  CHECK_THAT(error_of(sample_of(Nested{kTwo, {}})), Contains("world 2 of 2: there are no values"));
  CHECK_THAT(error_of(world_means(Nested{})), Contains("there are no worlds"));
  CHECK_THAT(error_of(paired_differences(Nested{{}}, Nested{{}})),
             Contains("world 1 of 1: there are no values"));
  CHECK_THAT(error_of(probability_of_improvement(Nested{}, Nested{})), Contains("there are no worlds"));
  CHECK_THAT(error_of(estimate_mean(kTwo, {.draws = 0})), Contains("at least one draw"));
  CHECK_THAT(error_of(sign_flips(kTwo, {.draws = 0})), Contains("at least one draw"));
}

TEST_CASE("a rate needs runs, and no more successes than runs", "[batch][statistics]") {
  CHECK_THAT(error_of(wilson_interval(0, 0)), Contains("there are no runs"));
  CHECK_THAT(error_of(wilson_interval(3, 2)), Contains("3 successes in 2 runs"));
  CHECK(wilson_interval(0, 1).value().low == 0.0);
  CHECK(wilson_interval(1, 1).value().high == 1.0);
}

TEST_CASE("tests without differences are refused, and of zeros p is 1", "[batch][statistics]") {
  CHECK_THAT(error_of(sign_flips(kNone)), Contains("there are no values"));
  CHECK_THAT(error_of(student_p(kNone)), Contains("there are no values"));
  const std::vector<double> zeros(30, 0.0);
  CHECK(sign_flips(zeros).value().used == 0);
  CHECK(sign_flips(zeros).value().p == 1.0);
  CHECK(student_p(std::vector{0.0, 0.0, 0.0}).value() == 1.0);
  CHECK(sign_flips(std::vector{0.5}).value().p == 1.0);
  CHECK(student_p(std::vector{0.5}).value() == 1.0);
}

TEST_CASE("a few equal differences are no proof, although they have no spread", "[batch][statistics]") {
  CHECK(student_p(std::vector{-2.0, -2.0, -2.0}).value() == 0.25);
  const Nested first{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, {7.0, 8.0, 9.0}};
  Nested second = first;
  for (std::vector<double>& world : second)
    for (double& value : world) value += 2.0;
  const Finding finding = find_difference(first, second, Quantity::number).value();
  CHECK(finding.test == Test::student);
  CHECK(finding.difference.interval == Interval{-2.0, -2.0});
  CHECK_FALSE(judge(finding, finding.p).value().established());
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
  const std::vector<double> few(4, 0.1);
  for (const Estimate& estimate : {estimate_mean(values).value(), estimate_mean(few).value(),
                                   estimate_mean(std::vector<double>(12, 0.1)).value()}) {
    CHECK(estimate.value == 0.1);
    CHECK(estimate.interval == Interval{0.1, 0.1});
  }
  CHECK(probability_of_improvement(worlds, worlds).value() == 0.5);
}

TEST_CASE("one value says nothing of others", "[batch][statistics]") {
  CHECK(estimate_mean(std::vector{4.0}).value().interval == Interval{-kEndless, kEndless});
  CHECK(estimate_share(std::vector{1.0}, {0.0, 1.0}).value().interval == Interval{0.0, 1.0});
}

TEST_CASE("successes alone do not show that failures are impossible", "[batch][statistics]") {
  const double most = wilson_interval(0, 20).value().high;  // 16 %
  const std::vector<double> ones(20, 1.0);
  const std::vector<double> zeros(20, 0.0);
  CHECK(estimate_share(ones, {0.0, 1.0}).value().interval == Interval{1.0 - most, 1.0});
  CHECK(estimate_share(zeros, {0.0, 1.0}).value().interval == Interval{0.0, most});
  CHECK(estimate_share(zeros, {-1.0, 1.0}).value().interval == Interval{-most, most});
  const Interval few = estimate_share(std::vector{1.0, 1.0, 0.5}, {0.0, 1.0}).value().interval;
  CHECK(few.high == 1.0);  // Student's would end at 155 %
  CHECK(few.low > 0.0);
}

TEST_CASE("from three worlds on each world is one value, before that each run is", "[batch][statistics]") {
  const Sample two = sample_of(Nested{{1.0}, {3.0, 5.0}}).value();
  CHECK(two.values == std::vector{1.0, 3.0, 5.0});
  CHECK_FALSE(two.scope.over_worlds());
  const Sample three = sample_of(Nested{{1.0}, {3.0, 5.0}, {2.0}}).value();
  CHECK(three.values == std::vector{1.0, 4.0, 2.0});
  CHECK(three.scope.over_worlds());
  CHECK(world_means(Nested{{1.0}, {3.0, 5.0}}).value() == std::vector{1.0, 4.0});
}

TEST_CASE("a claim names its worlds where they are few", "[batch][statistics]") {
  CHECK(Scope{1}.text() == " in this world");
  CHECK(Scope{2}.text() == " in these 2 worlds");
  CHECK(Scope{9}.text() == " in these 9 worlds");
  CHECK(Scope{10}.text().empty());
}

TEST_CASE("a difference is established with 9 runs, a small p-value and an interval without 0",
          "[batch][statistics]") {
  const Verdict verdict = verdict_of(finding_of({0.001, 0.02}), 0.05);
  CHECK(verdict.established());
  CHECK(verdict.text == "difference established");
  CHECK(verdict_of(finding_of({-0.02, -0.001}, 500), 0.0).established());
  CHECK(verdict_of(finding_of({0.001, 0.02}, 20, 1), 0.05).text == "difference established in this world");
  CHECK(verdict_of(finding_of({0.001, 0.02}, 20, 6), 0.05).text ==
        "difference established in these 6 worlds");
}

TEST_CASE("a difference that is not established gives every reason", "[batch][statistics]") {
  const Verdict few = verdict_of(finding_of({0.001, 0.02}, 8), 0.01);
  CHECK(few.doubts == std::vector{Doubt::too_few_runs});
  CHECK_FALSE(is_enough(finding_of({0.001, 0.02}, 8)));
  CHECK_FALSE(is_enough(finding_of({0.001, 0.02}, 50, 5)));
  CHECK(is_enough(finding_of({-1.0, 1.0})));
  CHECK(few.text == "not established: too few runs (8 of each, at least 9 are needed)");
  const Verdict worlds = verdict_of(finding_of({0.001, 0.02}, 50, 5), 0.01);
  CHECK(worlds.text == "not established: too few worlds (5, at least 6 are needed)");
  const Verdict wide = verdict_of(finding_of({0.0, 0.02}), 0.01);
  CHECK(wide.text == "not established: the interval includes 0");
  const Verdict chance = verdict_of(finding_of({0.001, 0.02}), 0.0512);
  CHECK(chance.text == "not established: the adjusted p-value 0.0512 is above 0.05");
  const Verdict both = verdict_of(finding_of({-0.25, 0.1234}), 1.0);
  CHECK(both.doubts.size() == 2);
  CHECK(both.text == "not established: the interval includes 0; the adjusted p-value 1 is above 0.05");
  const Verdict little = verdict_of(finding_of({-0.25, 0.1234}, 0, 3), 1.0);
  CHECK(little.text ==
        "not established: too few runs (0 of each, at least 9 are needed); too few worlds (3, at least 6 are "
        "needed)");
}

TEST_CASE("Student's test speaks of three worlds, and flipped signs need six", "[batch][statistics]") {
  const Nested times{{1.0, 1.1}, {2.0, 2.1}, {3.0, 3.2}, {4.0, 4.1}, {5.0, 5.2}};
  const Nested later{{2.0, 2.0}, {3.0, 3.2}, {4.0, 4.3}, {5.0, 5.0}, {6.0, 6.3}};
  const Finding time = find_difference(later, times, Quantity::number).value();
  CHECK(time.test == Test::student);
  CHECK(judge(time, time.p).value().text == "difference established in these 5 worlds");
  const Nested all(5, {1.0, 1.0});
  const Nested none(5, {0.0, 0.0});
  const Finding success = find_difference(all, none, Quantity::success).value();
  CHECK(success.p == 0.0625);
  CHECK_THAT(judge(success, success.p).value().text, Contains("too few worlds (5, at least 6"));
  const Nested six(6, {1.0, 1.0});
  const Nested no_six(6, {0.0, 0.0});
  CHECK(find_difference(six, no_six, Quantity::success).value().p == 0.03125);
}

TEST_CASE("a claim with a margin looks where the interval lies beside it", "[batch][statistics]") {
  const auto text_of = [](const Asked& asked, const Interval& interval) {
    Finding finding = finding_of(interval);
    finding.asked = asked;
    return verdict_of(finding, 0.01).text;
  };
  const Asked slower{.claim = Claim::not_worse, .margin = 2.0, .more_is_better = false};
  CHECK(text_of(slower, {-9.0, 1.9}) == "established");
  CHECK(text_of(slower, {-1.0, 2.0}) == "not established: the interval reaches the margin");
  const Asked weaker{.claim = Claim::not_worse, .margin = 0.05, .more_is_better = true};
  CHECK(text_of(weaker, {-0.04, 0.3}) == "established");
  CHECK(text_of(weaker, {-0.05, 0.3}) == "not established: the interval reaches the margin");
  const Asked same{.claim = Claim::equal, .margin = 2.0};
  CHECK(text_of(same, {-1.9, 1.9}) == "established");
  CHECK(text_of(same, {-2.0, 1.0}) == "not established: the interval reaches the margin");
  CHECK(text_of(same, {-1.0, 2.0}) == "not established: the interval reaches the margin");
  CHECK(text_of(slower, {1.9, 9.0}) == "not established: the interval reaches the margin");
  const std::string against =
      "not established: the whole interval lies beyond the margin, which speaks against the claim";
  CHECK(text_of(slower, {2.1, 9.0}) == against);
  CHECK(text_of(weaker, {-0.9, -0.06}) == against);
  CHECK(text_of(same, {2.1, 3.0}) == against);
  CHECK(text_of(same, {-3.0, -2.1}) == against);
  Finding spread = finding_of({1.9, 9.0});
  spread.asked = slower;
  spread.spread = 1.0;
  CHECK(spread.values_needed().has_value());
  spread.difference.interval = {2.1, 9.0};
  CHECK_FALSE(spread.values_needed().has_value());  // no number of worlds is likely to show it
}

TEST_CASE("a test with a margin is one-sided, and two of them for equality", "[batch][statistics]") {
  const Nested first{{1.5}, {2.0}, {2.5}, {3.5}, {2.0}, {2.5}, {1.0}, {2.0}};
  const Nested zeros(8, {0.0});
  const auto p_of = [&](Claim claim, double margin, bool more_is_better) {
    return find_difference(first, zeros, Quantity::number, {claim, margin, more_is_better}).value().p;
  };
  CHECK(p_of(Claim::difference, 0.0, false) == 2.0 / 256.0);
  CHECK(p_of(Claim::not_worse, 1.0, true) == 2.0 / 256.0);                   // all values are above -1
  CHECK(p_of(Claim::not_worse, 4.0, false) == 2.0 / 256.0);                  // and below 4
  CHECK(p_of(Claim::not_worse, 2.0, false) == 1.0);                          // the mean is 2.125
  const std::vector<double> below{1.5, 1.0, 0.5, -0.5, 1.0, 0.5, 2.0, 1.0};  // 3 - first
  CHECK(p_of(Claim::not_worse, 3.0, false) == sign_flips(below).value().p);
  CHECK(p_of(Claim::equal, 3.0, false) == sign_flips(below).value().p);  // the side that is nearer
  CHECK(p_of(Claim::equal, 2.0, false) == 1.0);
}

TEST_CASE("a comparison without numbers has no verdict", "[batch][statistics]") {
  for (const double p : {-0.1, 1.1, kNoNumber})
    CHECK_THAT(error_of(judge(finding_of({1, 2}), p)), Contains("p-value"));
  for (const Interval& interval : {Interval{2, 1}, Interval{kNoNumber, 1}, Interval{1, kNoNumber}})
    CHECK_THAT(error_of(judge(finding_of(interval), 0.01)), Contains("the lower one first"));
}
