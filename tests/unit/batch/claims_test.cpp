// SPDX-License-Identifier: GPL-3.0-or-later
// What a report claims: about this world or its kind, about families of worlds, and about what was declared.
#include <catch2/catch.hpp>

#include <map>

#include "made_results.hpp"
#include "report/families.hpp"
#include "report/numbers.hpp"

using namespace orca;
using namespace orca::batch;
using Catch::Contains;
using Catch::StartsWith;

TEST_CASE("in one world runs are compared, and the claim is about this world", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0, 50.0);
  add(rows, "good", 0, 60.0);
  move_into_one_world(rows);
  const Report report = report_on(rows);
  CHECK_THAT(report.markdown, Contains("| sign flips, 20 runs |") && !Contains("worlds |"));
  CHECK_THAT(report.summary,
             Contains("20 runs, 100.0 % (83.9 % to 100.0 %) succeed (95 % over seeds, in this world)"));
  CHECK_THAT(report.summary,
             Contains("time [s]: -10.0 (-10.0 to -10.0), difference established in this world"));
}

TEST_CASE("seeds that change nothing are one run, and no evidence", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0, 50.0);
  add(rows, "good", 0, 60.0);
  move_into_one_world(rows);
  for (Row& row : rows) {  // as without errors
    row.outcome.trace_hash = row.variant;
    row.outcome.time = row.variant == "bad" ? 51.0 : 61.0;
    row.outcome.measures.way = 30.0;
  }
  const auto same = compare(rows, {pairs_in(rows, {"success", "time"}), {}});
  REQUIRE(same);
  CHECK(in(*same, "time").finding.runs == 1);
  CHECK_FALSE(in(*same, "time").verdict.established());
  CHECK(same->variants[0].runs == 1);
  CHECK(same->matrix.at({"bad", "w10"}) == std::pair<std::size_t, std::size_t>(1, 1));
  for (const std::string& text : {report_on(rows).summary, report_on(rows).markdown})
    CHECK_THAT(text, Contains("20 seeds gave 1 run in world w10: no seed changed how the robots drove"));
  CHECK_THAT(report_on(rows).summary,
             Contains("time [s]: -10.0 (of one), not established: too few runs (1 of each"));
  CHECK_THAT(report_on(rows).summary, Contains("bad: 1 run, 100.0 % (0.0 % to 100.0 %)"));
}

TEST_CASE("noise that moves no robot is no evidence, though the traces differ", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "slow", 0);
  add(rows, "quick", 0);
  move_into_one_world(rows);
  for (Row& row : rows) {
    row.outcome.trace_hash = row.variant + std::to_string(row.seed);
    row.outcome.time = row.variant == "slow" ? 22.8 : 14.2;
    row.outcome.measures.way = 30.0;
  }
  const auto result = compare(rows, {pairs_in(rows, {"time"}), {}});
  REQUIRE(result);
  CHECK(result->variants[0].runs == 1);
  CHECK_FALSE(in(*result, "time").verdict.established());
  SECTION("but robots that never moved had no motion to compare: each trace is a run") {
    for (Row& row : rows)
      if (row.variant == "slow") row.outcome.measures.way = 0.0;
    const auto one_stands = compare(rows, {pairs_in(rows, {"time"}), {}});
    REQUIRE(one_stands);
    CHECK(in(*one_stands, "time").finding.runs == 20);
  }
}

TEST_CASE("worlds in which all is the same are one world", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0, 50.0);
  add(rows, "good", 0, 60.0);
  for (Row& row : rows) {
    row.outcome.time = row.variant == "bad" ? 51.0 : 61.0;
    row.outcome.measures.way = 30.0;
  }
  const auto result = compare(rows, {pairs_in(rows, {"success", "time"}), {}});
  REQUIRE(result);
  CHECK(result->variants[0].runs == 1);
  CHECK_FALSE(in(*result, "time").verdict.established());
  CHECK_FALSE(in(*result, "time").finding.scope.over_worlds());
  CHECK(result->matrix.at({"bad", "w29"}) == std::pair<std::size_t, std::size_t>(1, 1));
  REQUIRE(result->same_runs.size() == 1);
  CHECK(result->same_runs[0].worlds.size() == 19);
  CHECK_THAT(line_of(result->same_runs[0], 2),
             StartsWith("all runs in each of the worlds w11") && Contains("repeat those in another world"));
}

TEST_CASE("failures that did not come before the runs ended are counted", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0, 50.0);
  add(rows, "good", 0, 60.0);
  Experiment asked = experiment();
  for (World& world : asked.worlds)
    world.failing.push_back({.component = "pilot", .how = "throw", .at = std::chrono::seconds(56)});
  CHECK_THAT(report_on(rows, asked).summary,
             Contains("the failure pilot=throw@56s did not come in 20 of 40 runs, which ended before"));
  CHECK_THAT(report_on(rows, asked).markdown, Contains("did not come in 20 of 40 runs"));
  CHECK_THAT(report_on(rows, experiment()).summary, !Contains("did not come"));
}

TEST_CASE("variants that are the same in all runs are named", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0, 60.0);
  add(rows, "good", 0, 60.0);
  CHECK_THAT(report_on(rows).summary,
             Contains("bad, good made the same 20 runs: what sets them apart did nothing there"));
  rows.front().outcome.time += 0.1;
  CHECK_THAT(report_on(rows).summary, !Contains("did nothing"));
}

TEST_CASE("why runs failed is told beside the figures, the commonest reasons first", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0, 50.0);
  add(rows, "good", 0, 60.0);
  CHECK_THAT(report_on(rows).summary, !Contains("why "));
  const auto fail_at = [&](std::size_t row, const std::string& reason) {
    rows[row].outcome.ending = Ending::failed;
    rows[row].outcome.reason = reason;
  };
  fail_at(0, "rare");
  for (const std::size_t row : {5U, 6U}) fail_at(row, "a goal is at the place \"kichen\"");
  CHECK_THAT(report_on(rows).summary, Contains("why 2 runs failed (first " + rows[5].variant + " in " +
                                               rows[5].world + ", seed " + std::to_string(rows[5].seed) +
                                               "): a goal is at the place \"kichen\"\nwhy 1 run failed"));
  CHECK_THAT(report_on(rows).markdown, Contains("why 2 runs failed"));
  for (const std::size_t row : {10U, 11U}) fail_at(row, "another " + std::to_string(row));
  CHECK_THAT(report_on(rows).summary, Contains("other runs failed for 1 more reason: see the report"));
}

TEST_CASE("goals that are reached at once are told", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0, 50.0);
  add(rows, "good", 0, 60.0);
  CHECK_THAT(report_on(rows).summary, !Contains("at once"));
  for (Row& row : rows)
    if (row.variant == "good") row.outcome.time = 0.01;
  CHECK_THAT(report_on(rows).summary,
             Contains("all goals were reached at once in 20 runs: do they lie where the robots start?"));
}

TEST_CASE("a pair counts unless both variants repeat themselves", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "fixed", 0, 50.0);
  add(rows, "noisy", 0, 60.0);
  move_into_one_world(rows);
  for (Row& row : rows) {
    row.outcome.trace_hash = row.variant == "fixed" ? "f" : "n" + std::to_string(row.seed / 2);
    row.outcome.time = row.variant == "fixed" ? 51.0 : 61.0 + 0.1 * static_cast<double>(row.seed / 2);
    row.outcome.measures.way = 30.0;
  }
  const auto result = compare(rows, {pairs_in(rows, {"time"}), {}});
  REQUIRE(result);
  CHECK(in(*result, "time").finding.runs == 10);
  CHECK(result->variants[0].runs == 1);
  CHECK(result->variants[1].runs == 10);
  REQUIRE(result->same_runs.size() == 2);
  CHECK(line_of(result->same_runs[0], 2) ==
        "20 seeds gave 1 run of fixed in world w10: no seed changed how the robots drove");
  CHECK(line_of(result->same_runs[1], 2) ==
        "20 seeds gave 10 runs of noisy in world w10: the other seeds repeat these");
}

TEST_CASE("families of worlds that contradict each other are a reversal, and nothing is claimed of all",
          "[batch][report]") {
  // As commit 103f5d5c had it: Dwa 95 and 7 %, LaserAvoid 85 and 87 %; together 77 and 85 %, which is not established.
  std::vector<Row> rows;
  std::map<std::string, std::string> families;
  const auto add_family = [&](const std::string& family, int worlds, int dwa, int laser_avoid) {
    for (int i = 0; i < worlds; ++i) {
      const std::string world = family + "_" + std::to_string(i);
      families[world] = family;
      for (const auto& [variant, successes] : {std::pair("Dwa", dwa), std::pair("LaserAvoid", laser_avoid)}) {
        const int turned = successes == laser_avoid ? worlds - 1 - i : i;  // they fail in different worlds
        Row row{variant, world, 1, {}, {}};
        row.outcome.ending = turned < successes ? Ending::success : Ending::time_out;
        rows.push_back(row);
      }
    }
  };
  add_family("posts", 160, 152, 136);
  add_family("offices", 40, 3, 35);
  const auto pooled = compare(rows, {pairs_in(rows, {"success"}), {}});
  REQUIRE(pooled);
  CHECK(pooled->families.empty());
  CHECK_THAT(line_of(in(*pooled, "success")),
             Contains("Dwa - LaserAvoid, success: -8.0 %") && Contains("not established"));
  const auto result = compare(rows, {pairs_in(rows, {"success"}), families});
  REQUIRE(result);
  REQUIRE(result->families.size() == 2);
  CHECK(result->families[1].name == "posts");
  CHECK(result->families[1].worlds == 160);
  CHECK(result->families[1].success.at("Dwa").mean.value == Approx(0.95));
  CHECK(result->families[0].success.at("LaserAvoid").mean.value == Approx(0.875));
  REQUIRE(result->reversals.size() == 1);
  CHECK_THAT(line_of(result->reversals[0]),
             Contains("Reversal in success: Dwa is better than LaserAvoid in posts, 10.0 % (") &&
                 Contains("), and worse in offices, -80.0 % (") &&
                 Contains("nothing is claimed about all worlds together"));
  CHECK(in(*result, "success").verdict.text == "not claimed: families of worlds contradict each other");
}

TEST_CASE("a reversal is said first, on stdout and on both pages, and families have their tables and curves",
          "[batch][report]") {
  std::vector<Row> rows;
  for (const std::string variant : {"a", "b"})
    for (const std::string family : {"left", "right"})
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        Row row{variant, family, seed, {}, {}};
        row.outcome.ending = Ending::success;
        row.outcome.time = 50.0 + (variant == family.substr(0, 1) ? 1.0 : 0.0) +
                           0.1 * static_cast<double>(seed) +
                           (variant == "a" && family == "right" ? 3.0 : 0.0) +
                           (variant == "b" && family == "left" ? 3.0 : 0.0);
        rows.push_back(row);
      }
  xml::Diagnostics diagnostics;
  const auto experiment = read_experiment(
      R"(<experiment name="e" graph="g.xml" seeds="1-12" until="200 s"><variant name="a"/><variant name="b"/>
         <world name="left"/><world name="right"/></experiment>)",
      "/top/e.xml", diagnostics);
  REQUIRE(experiment);
  const Report report = report_on(rows, *experiment);
  CHECK(report.summary.rfind("Reversal in time: a is better than b in left, -3.000 (", 0) == 0);
  CHECK_THAT(report.markdown, StartsWith("# Comparison: e\n\n## Read this first\n\nReversal in time"));
  CHECK(report.html.find("<h2>Read this first</h2>") == report.html.find("<h2>"));
  CHECK_THAT(report.markdown, Contains("## Family by family") && Contains("| left | 1 | 100.0 %") &&
                                  Contains("| time [s] | a - b | right | difference established in this "
                                           "world: b is better | 3.000 (3.000 to 3.000) |") &&
                                  Contains("Family right: share of the runs that were done by then."));
}

TEST_CASE("a claim over all worlds says in which families it is established", "[batch][report]") {
  std::vector<Row> rows;
  std::map<std::string, std::string> families;
  for (const std::string variant : {"bad", "good"})
    for (const std::string family : {"easy", "hard"})
      for (int i = 0; i < 12; ++i) {
        const std::string world = family + std::to_string(i);
        families[world] = family;
        Row row{variant, world, 1, {}, {}};
        row.outcome.ending =
            variant == "bad" && family == "hard" && i < 10 ? Ending::time_out : Ending::success;
        rows.push_back(row);
      }
  const auto result = compare(rows, {pairs_in(rows, {"success"}), families});
  REQUIRE(result);
  const Difference& pooled = in(*result, "success");
  CHECK(claim_text(pooled) + families_text(pooled, *result) ==
        "difference established: good is better; by family: good is better in hard");
}

TEST_CASE("worlds of one family, and families without runs enough, have no section of their own",
          "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 5);
  add(rows, "good", 0);
  CHECK_THAT(report_on(rows).markdown, !Contains("Family by family"));  // twenty families of one run
  std::map<std::string, std::string> one;
  for (const Row& row : rows) one[row.world] = "all";
  CHECK(compare(rows, {pairs_in(rows, {"success"}), one})->families.empty());
}

TEST_CASE("only what is declared is asked, and Holm's correction counts no more", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0, 60.5);
  add(rows, "good", 0, 60.0);
  for (Row& row : rows)  // differ by 0.5 s, and from world to world by some tenths
    if (row.variant == "bad")
      row.outcome.time += 0.1 * static_cast<double>(std::stoi(row.world.substr(1)) % 3);
  const Contrast slower{.first = "bad",
                        .second = "good",
                        .metric = "time",
                        .asked = {Claim::not_worse, 1.0, false},
                        .margin = "1 s"};
  const Contrast same{.first = "bad",
                      .second = "good",
                      .metric = "success",
                      .asked = {Claim::equal, 0.1, true},
                      .margin = "10 %"};
  const auto alone = compare(rows, {{slower}, {}});
  REQUIRE(alone);
  REQUIRE(alone->differences.size() == 1);
  CHECK(alone->differences[0].adjusted_p == alone->differences[0].finding.p);
  CHECK(line_of(alone->differences[0]).find("bad - good, time [s]: 0.605 (") == 0);
  CHECK_THAT(line_of(alone->differences[0]), Contains(", established: bad is not worse than good by 1 s"));
  const auto both = compare(rows, {{slower, same}, {}});
  REQUIRE(both->differences.size() == 2);
  CHECK_THAT(line_of(both->differences[1]), Contains("success: 0.0 % (-16.1 % to 16.1 %), not established: "
                                                     "the interval reaches the margin (bad and good "
                                                     "are equal within 10 %)"));
  CHECK(question_text(same) == "bad - good, equal within 10 %");
}

TEST_CASE("the page says how many worlds a question needs", "[batch][report]") {
  Finding finding{.scope = {20}, .difference = {1.0, {-1.0, 3.0}}};
  finding.spread = 4.0;
  // n = 128: (scipy.stats.t.ppf(0.975, 127) + scipy.stats.t.ppf(0.8, 127))**2 * 16 = 127.6; of 127 it is 127.6 as well
  CHECK(needed_text(finding) == "128 worlds");
  finding.scope = {1};
  CHECK(needed_text(finding) == "128 runs");
  finding.spread = 1e4;
  CHECK(needed_text(finding) == "more than 100000 runs");
  finding.spread = 0.0;
  CHECK(needed_text(finding).empty());
}

TEST_CASE("the page says what was declared when, and what was changed since", "[batch][report]") {
  const test::TempFolder folder;
  const auto store = Store::open(folder.file("r.sqlite"), "1").value();
  std::vector<Row> rows;
  add(rows, "good", 3);
  const Experiment declared = experiment();
  REQUIRE(store->declare(declarations_of(declared, "2026-11-28 10:00 UTC")).ok());
  for (const Row& row : rows) REQUIRE(store->add(row).ok());
  const std::string before = make_report(declared, *store)->markdown;
  CHECK_THAT(before, Contains("| 2026-11-28 10:00 UTC | metrics | success, time |") &&
                         Contains("| contrasts | all pairs of variants in all metrics |") &&
                         Contains("| seeds | 1 |") && Contains("| worlds | w10, w11, w12") &&
                         Contains("Nothing was added or exchanged since then."));
  Experiment more = declared;
  more.seeds = {1, 2, 3, 7};
  more.metrics = {"clearance"};
  REQUIRE(store->declare(declarations_of(more, "2026-11-29 11:00 UTC")).ok());
  CHECK_THAT(make_report(more, *store)->markdown,
             Contains("| 2026-11-29 11:00 UTC | metrics, changed | clearance |") &&
                 Contains("| 2026-11-29 11:00 UTC | seeds, changed | 1-3 7 |") &&
                 !Contains("worlds, changed") && Contains("Not all of it was declared at first."));
}

TEST_CASE("a question that no pair of runs answers is not left out without a word", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0);
  add(rows, "good", 0);
  const auto result = compare(rows, {pairs_in(rows, {"success", "barn_score"}), {}});
  REQUIRE(result);
  REQUIRE(result->unanswered.size() == 1);
  CHECK(line_of(result->unanswered[0]) ==
        "bad - good, barn_score: no answer, since in no world and seed both have a value");
}
