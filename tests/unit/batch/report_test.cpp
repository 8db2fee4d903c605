// SPDX-License-Identifier: GPL-3.0-or-later
// What a report says of results whose truth is known.
#include "orca/batch/report.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "approval.hpp"
#include "made_results.hpp"
#include "orca/xml/document.hpp"
#include "report/document.hpp"
#include "report/numbers.hpp"
#include "report/plots.hpp"

using namespace orca;
using namespace orca::batch;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;
using orca::test::TempFolder;

TEST_CASE("a clear difference between two variants is called established", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 15);
  add(rows, "good", 0);
  const Report report = report_on(rows);
  CHECK_THAT(report.summary, Contains("bad: 20 runs, 25.0 % (") && Contains(", 15 time_out"));
  CHECK_THAT(report.summary, Contains("good: 20 runs, 100.0 %"));
  CHECK_THAT(report.summary, Contains("bad - good, success: -75.0 % (") &&
                                 Contains("), difference established: good is better"));
}

TEST_CASE("equal variants, and ones with few runs, are not told apart", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 3);
  add(rows, "good", 3);
  CHECK_THAT(report_on(rows).summary,
             Contains("bad - good, success: 0.0 %") && Contains("not established: "));
  CHECK_THAT(report_on({rows[5], rows[25]}).summary, Contains("not established: "));
}

TEST_CASE("one variant alone is compared with nothing, and no runs give no report", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "good", 3);
  CHECK(report_on(rows).summary.find(" - ") == std::string::npos);
  const TempFolder folder;
  const auto made = make_report(experiment(), *Store::open(folder.file("r.sqlite"), "1").value());
  REQUIRE_FALSE(made);
  CHECK_THAT(made.error().message, Contains("no results yet"));
}

TEST_CASE("times are compared where both succeed, by the means of worlds", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "fast", 2, 50.0);
  add(rows, "slow", 5, 60.0);
  const auto result = compare(rows, {pairs_in(rows, {"success", "time"}), {}});
  REQUIRE(result);
  const Difference& time = in(*result, "time");
  CHECK(time.finding.runs == 15);
  CHECK(time.finding.scope.worlds == 15);
  CHECK(time.finding.difference.value == Approx(-10.0));
  CHECK(time.improvement == 1.0);
  CHECK(time.verdict.established());
  CHECK(time.finding.p == Approx(std::ldexp(1.0, -14)));  // two of the 2^15 choices of signs
  CHECK(time.adjusted_p == 2.0 * time.finding.p);         // the smaller of two tests, by Holm
  CHECK(result->variants[0].metrics.at("time").runs == 18);
  CHECK(result->matrix.at({"slow", "w12"}) == std::pair<std::size_t, std::size_t>(0, 1));
}

TEST_CASE("a metric that there is not is refused", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "a", 0);
  add(rows, "b", 0);
  CHECK_FALSE(compare(rows, {pairs_in(rows, {"beauty"}), {}}));
  xml::Diagnostics diagnostics;
  CHECK_FALSE(
      read_experiment(R"(<experiment name="e" graph="g.xml" seeds="1" until="1 s" metrics="success tme">
    <variant name="a"/><world name="w"/></experiment>)",
                      "e.xml", diagnostics));
  CHECK_THAT(diagnostics.text(),
             Contains("there is no metric \"tme\"") && Contains("did you mean \"time\"?"));
}

TEST_CASE("each drawing is an SVG and a PDF file of its own, each table a LaTeX file", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad_one", 5);
  add(rows, "good", 0);
  const Report report = report_on(rows);
  for (const char* name : {"figures/times-and-speeds-1.svg", "figures/where-they-drove-1.svg",
                           "figures/where-they-drove-2.svg", "figures/runs-without-success-1.svg"}) {
    CAPTURE(name);
    const std::string& drawing = report.files.at(name);
    xml::Diagnostics diagnostics;
    CHECK(xml::read_text(drawing, name, diagnostics));
    CHECK(diagnostics.text().empty());
    CHECK_THAT(report.html, Contains(drawing.substr(drawing.find("</desc>") + 7)));
    const std::string pdf = std::string(name).replace(std::string(name).size() - 3, 3, "pdf");
    CHECK_THAT(report.files.at(pdf),
               StartsWith("%PDF-1.") && EndsWith("%%EOF\n") && !Contains("/CreationDate"));
    CHECK(report_on(rows).files.at(pdf) == report.files.at(pdf));
  }
  CHECK_THAT(report.files.at("figures/times-and-speeds-1.svg"),
             Contains("<desc>Share of the runs that were done"));
  const std::string& table = report.files.at("tables/success-1.tex");
  CHECK_THAT(table, StartsWith("\\begin{tabular}{lllll}\n\\hline\nvariant & runs & success (95 \\%)"));
  CHECK_THAT(table, Contains("\nbad\\_one & 20 & 75.0 \\% (") && EndsWith("\\hline\n\\end{tabular}\n"));
}

TEST_CASE("metrics that no run has are named with what they need", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 20);
  add(rows, "good", 20);
  const std::string page = report_on(rows).markdown;
  CHECK_THAT(page, Contains("No run has time: it takes a success."));
  CHECK_THAT(
      page,
      Contains("No run has people_touched, people_run_into, near_misses: it takes a world with people."));
  CHECK_THAT(page, Contains("No run has way, jerk: it takes a success and a simulated robot."));
  CHECK_THAT(page, !Contains("No run has clearance:"));
}

TEST_CASE("no interval of a measure goes below 0, and none of a share beyond 1", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 0);
  for (Row& row : rows) {
    const bool is_first = row.world == "w10";
    row.outcome.measures.noticed = is_first ? 0.7 : 1.0;
    row.outcome.measures.sure_but_wrong = is_first ? 0.3 : 0.0;
    row.outcome.measures.people_touched = is_first ? 3.0 : 0.0;
  }
  rows.resize(4);  // few worlds: Student's intervals know no bounds
  const std::string page = report_on(rows, experiment()).markdown;
  INFO(page);
  CHECK_THAT(page, Contains("| noticed | 0.925 (0.686 to 1.000)"));
  CHECK_THAT(page, Contains("| sure_but_wrong | 0.075 (0.000 to 0.314)"));
  CHECK_THAT(page, Contains("| people_touched | 0.750 (0.000 to 3.137)"));
}

TEST_CASE("a failed run is shown with its kind and the command that makes it again", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 5);
  add(rows, "good", 0);
  const std::string page = report_on(rows).markdown;
  CHECK_THAT(page, Contains("bad in w10, seed 1: time_out, trap"));
  CHECK_THAT(page,
             Contains("deployer 'g.xml' --clock virtual --seed 1 --until '200 s' --set 'a=it'\\''s <1>'"));
  CHECK_THAT(page, Contains("And 2 more of bad: time_out, trap"));
}

TEST_CASE("the HTML of a report is well-formed, whatever the names are, and needs nothing else",
          "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 5);
  add(rows, "good", 0);
  const std::string page = report_on(rows).html;
  xml::Diagnostics diagnostics;
  CHECK(xml::read_text(page.substr(page.find("<html")), "report.html", diagnostics));
  INFO(diagnostics.text());
  CHECK_FALSE(diagnostics.has_errors());
  CHECK_THAT(page,
             Contains("a=it's &lt;1&gt;") && Contains("<svg") && !Contains("src=") && !Contains("href="));
}

TEST_CASE("the report of nine runs of each variant is the approved one, in Markdown and in HTML",
          "[batch][report][approval]") {
  std::vector<Row> rows;
  for (int run = 0; run < 9; ++run) {
    const std::uint64_t seed = 1U + static_cast<std::uint64_t>(run) % 3U;
    const std::string world = "w1" + std::to_string(run / 3);
    for (const bool good : {false, true}) {
      Row row{good ? "good" : "bad", world, seed, {}, {}};
      row.outcome.time = 40.0 + (good ? 2.0 : 3.0) * run;
      row.outcome.ending = good || run > 4 ? Ending::success : run > 2 ? Ending::failed : Ending::time_out;
      if (row.outcome.ending == Ending::time_out) row.outcome.failure = Failure::trap;
      if (row.outcome.ending == Ending::failed) row.outcome.reason = "avoid: it threw";
      row.outcome.measures = {.way = 20.0 + 0.5 * run, .clearance = 0.25 + 0.125 * run};
      row.outcome.sketch.tracks = "0.00 0.00,1.50 " + std::to_string(run) + ".25;3.00 -1.00";
      rows.push_back(row);
    }
  }
  const Report report = report_on(rows);
  const std::filesystem::path folder = std::filesystem::path(ORCA_SOURCE_DIR) / "tests/data/reports";
  test::check_approved(folder / "two_variants.markdown", report.markdown);
  test::check_approved(folder / "two_variants.html", report.html);
}

TEST_CASE("the curve of a distribution rises at each value, by the share of all runs", "[batch][report]") {
  const std::string plot = to_svg(distribution_plot("x", {{"a", {1.0, 3.0}, 4}}));
  const std::size_t begin = plot.find("points=\"") + 8;
  const std::string points = plot.substr(begin, plot.find('"', begin) - begin);
  // 438 pixels for 0.9 to 3.1, 268 pixels for 0 to 1; two of four runs have a value.
  CHECK(points == "52.0,280.0 71.9,280.0 71.9,213.0 470.1,213.0 470.1,146.0 490.0,146.0 ");
  CHECK_THAT(plot, Contains(">0 %</text>") && Contains(">100 %</text>") && Contains(">a</text>"));
}

TEST_CASE("a table of Markdown survives bars and line ends", "[batch][report]") {
  Document document;
  document.title = "t";
  document.add(Table{{"a", "b"}, {{"x|y", "two\nlines"}}});
  CHECK(to_markdown(document) == "# t\n\n| a | b |\n| --- | --- |\n| x\\|y | two lines |\n\n");
}

TEST_CASE("lines are read as they were written, and what is no place is left out", "[batch][report]") {
  const auto lines = read_lines("0.00 1.25,-0.10 2.00;3.00 4.00");
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] == Places{{0.0, 1.25}, {-0.1, 2.0}});
  CHECK(lines[1] == Places{{3.0, 4.0}});
  CHECK(read_lines("").empty());
  CHECK(read_lines("1.00 1.00,far").at(0).size() == 1);
}

TEST_CASE("a map has a line for each wall and track, and a cross at each contact, to scale",
          "[batch][report]") {
  Map map{.walls = {{{0.0, 0.0}, {4.0, 0.0}, {4.0, 2.0}}}, .tracks = {{{{1.0, 1.0}, {3.0, 1.0}}, 0, true}}};
  const std::string without_contact = to_svg(map_plot(map));
  CHECK_THAT(without_contact, Contains("width=\"420\" height=\"237\""));  // 4.6 m by 2.6 m with the margins
  CHECK_THAT(without_contact, Contains("d=\"M27.4 210.0L392.6 210.0L392.6 27.4\""));
  CHECK_THAT(without_contact, Contains("points=\"118.7,118.7 301.3,118.7 \""));
  CHECK_THAT(without_contact, Contains("<circle cx=\"301.3\" cy=\"118.7\"") && !Contains("<line"));
  map.contacts = {{4.0, 1.0}};
  CHECK_THAT(to_svg(map_plot(map)), Contains("<line x1=\"387.6\" y1=\"113.7\" x2=\"397.6\" y2=\"123.7\""));
}

TEST_CASE("each failure that is shown has a picture with the walls and the contacts", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "bad", 2);
  const std::string page = report_on(rows).html;
  const std::string failures = page.substr(page.find("<h2>Runs without success"));
  for (const char* const part : {"<path", "<polyline", "a cross marks each of the first contacts"})
    CHECK_THAT(failures, Contains(part));
  CHECK_THAT(page.substr(0, page.find("<h2>Runs without success")),
             Contains("<path") && !Contains("a cross marks"));
}

TEST_CASE("where there are few worlds each shows how far its seeds are apart", "[batch][report]") {
  CHECK(spread_text({20.0, 30.0, 40.0}, *find_metric("time")) == "30.0 (20.0 to 40.0)");
  CHECK(spread_text({}, *find_metric("time")).empty());
  std::vector<Row> rows;
  add(rows, "bad", 0, 20.0);
  CHECK_THAT(report_on(rows).markdown, !Contains("world: time"));  // twenty worlds
  move_into_one_world(rows);
  CHECK_THAT(report_on(rows).markdown,
             Contains("| world: time [s] | bad |\n| --- | --- |\n| w10 | 21.9 (21.0 to 22.9) |"));
}

TEST_CASE("the page shows the mean processor time per lap over all runs, and the longest",
          "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "good", 0);
  CHECK_THAT(report_on(rows).markdown, !Contains("## Processor time"));  // no run has any
  rows[0].cost.laps = {{"avoid", 100, 0.001, 0.002, 0.004}};
  rows[1].cost.laps = {{"avoid", 300, 0.002, 0.003, 0.0035}, {"goto", 10, 0.00025, 0.0003, 0.0003}};
  CHECK_THAT(report_on(rows).markdown,
             Contains("| component | bad | good |\n| --- | --- | --- |\n| avoid |  | 1.75 ms (4 ms) |\n"
                      "| goto |  | 0.25 ms (0.3 ms) |\n"));
}

TEST_CASE("small p-values are not rounded to 0", "[batch][report]") {
  CHECK(p_text(0.0123) == "0.0123");
  CHECK(p_text(1e-7) == "< 0.0001");
}

TEST_CASE("worlds stand in the order of the experiment", "[batch][report]") {
  std::vector<Row> rows;
  add(rows, "good", 0);
  Experiment turned = experiment();
  std::ranges::reverse(turned.worlds);
  const std::string page = report_on(rows, turned).markdown;
  CHECK(page.find("| w29 | 1 of 1 |") < page.find("| w10 | 1 of 1 |"));
}
