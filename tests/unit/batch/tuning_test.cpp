// SPDX-License-Identifier: GPL-3.0-or-later
// What a tuner draws, and how wrong ranges and worlds are refused.
#include "orca/batch/tuning.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

using namespace orca;
using namespace orca::batch;
using Catch::Contains;

namespace {

std::string text_with(const std::string& variants, const std::string& tuning) {
  return R"(<experiment name="e" graph="g.xml" seeds="1" until="60 s">)" + variants +
         R"(<variant name="b"/><worlds name="n" arg="world" file="many.csv" numbers="1-3"/>)" + tuning +
         "</experiment>";
}

constexpr const char* kRanges = R"(<variant name="a"><set arg="near" value="0.1 m"/>
  <tune arg="near" from="50 mm" to="0.4 m"/><tune arg="factor" from="0.1" to="10" scale="log"/></variant>)";
constexpr const char* kTuning =
    R"(<tuning draws="200" seed="7"><worlds name="t" arg="world" file="many.csv" numbers="8-9"/></tuning>)";

Experiment experiment_of(const std::string& text) {
  xml::Diagnostics diagnostics;
  std::optional<Experiment> experiment = read_experiment(text, "/top/e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  return *std::move(experiment);
}

std::string faults_of(const std::string& variants, const std::string& tuning) {
  xml::Diagnostics diagnostics;
  CHECK_FALSE(read_experiment(text_with(variants, tuning), "/top/e.xml", diagnostics));
  return diagnostics.text();
}

double number_of(const Setting& setting) { return std::stod(setting.value); }

}  // namespace

TEST_CASE("a tuner runs each variant that has ranges as often as it draws, in worlds of its own",
          "[batch][tuning]") {
  const Experiment experiment = experiment_of(text_with(kRanges, kTuning));
  CHECK(experiment.worlds.size() == 3);
  const Result<Experiment> drawn = draws_of(experiment);
  REQUIRE(drawn);
  REQUIRE(drawn->variants.size() == 200);
  REQUIRE(drawn->worlds.size() == 2);
  CHECK(drawn->worlds[1].settings[0].text() == "world=/top/many.csv#9");
  CHECK(drawn->variants[0].name == "a_0");
  REQUIRE(drawn->variants[0].settings.size() == 1);
  CHECK(drawn->variants[0].settings[0].text() == "near=0.1 m");  // as declared

  int small_factors = 0;
  for (std::size_t i = 1; i < drawn->variants.size(); ++i) {
    const std::vector<Setting>& settings = drawn->variants[i].settings;
    REQUIRE(settings.size() == 2);  // the drawn value stands in the place of the declared one
    CHECK((number_of(settings[0]) >= 0.05 && number_of(settings[0]) <= 0.4));
    CHECK_THAT(settings[0].value, Catch::EndsWith(" m"));
    CHECK((number_of(settings[1]) >= 0.1 && number_of(settings[1]) <= 10.0));
    small_factors += number_of(settings[1]) < 1.0 ? 1 : 0;
  }
  CHECK((small_factors > 80 && small_factors < 120));  // by factors, half of the range is below 1
}

TEST_CASE("what is drawn for a variant depends on the seed, and on no other variant", "[batch][tuning]") {
  const Experiment alone = *draws_of(experiment_of(text_with(kRanges, kTuning)));
  const Experiment among_others = *draws_of(experiment_of(text_with(
      R"(<variant name="z"><tune arg="x" from="1" to="2"/></variant>)" + std::string(kRanges), kTuning)));
  CHECK(among_others.variants[205].settings[0].text() == alone.variants[5].settings[0].text());
  Experiment other = experiment_of(text_with(kRanges, kTuning));
  other.tuning->seed = 8;
  CHECK(draws_of(other)->variants[5].settings[0].text() != alone.variants[5].settings[0].text());
}

TEST_CASE("of two draws the one with fewer failures is better, however fast the other is",
          "[batch][tuning]") {
  const Tuned tuned{"a",
                    {{.number = 0, .penalised_time = 320.0},
                     {.number = 1, .penalised_time = 40.0},
                     {.number = 2, .penalised_time = 40.0}}};
  CHECK(tuned.best().number == 1);
}

TEST_CASE("ranges that are none and worlds that are compared in are refused", "[batch][tuning]") {
  const std::string faults =
      faults_of(R"(<variant name="a"><tune arg="x" from="1 m" to="2 s"/><tune arg="x" from="2" to="1"/>
        <tune arg="x" from="0" to="1" scale="log"/><tune arg="x" from="wide" to="1"/></variant>)",
                R"(<tuning draws="1"><worlds name="t" arg="world" file="many.csv" numbers="3-4"/></tuning>)");
  CHECK_THAT(faults, Contains("error E015: it must be above from, and of the same unit"));
  CHECK_THAT(faults, Contains("error E015: with scale=\"log\" it must be above 0"));
  CHECK_THAT(faults, Contains("error E015: ") && Contains("wide"));
  CHECK_THAT(faults, Contains("error E005: ") && Contains("draws"));
  CHECK_THAT(faults, Contains("error E015: world \"t_3\" of the tuner is \"n_3\" of the experiment"));
  CHECK_THAT(faults, !Contains("t_4"));
  CHECK_THAT(faults_of("", R"(<tuning draws="2"/>)"), Contains("error E004: a tuner needs a <world>"));
}

TEST_CASE("without ranges or a budget there is nothing to tune", "[batch][tuning]") {
  const Result<Experiment> no_budget = draws_of(experiment_of(text_with(kRanges, "")));
  REQUIRE_FALSE(no_budget);
  CHECK_THAT(no_budget.error().message, Contains("has no <tuning>"));
  const Result<Experiment> no_ranges = draws_of(experiment_of(text_with("", kTuning)));
  REQUIRE_FALSE(no_ranges);
  CHECK_THAT(no_ranges.error().message, Contains("has a <tune>"));
}
