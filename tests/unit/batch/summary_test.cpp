// SPDX-License-Identifier: GPL-3.0-or-later
// What simbatch says in the end.
#include "summary.hpp"

#include <catch2/catch.hpp>

using namespace orca::batch;
using Catch::Contains;
using orca::simbatch::summary_text;

namespace {

// Twenty worlds with one seed each; the first `failures` of them fail.
void add(std::vector<Row>& rows, const std::string& variant, int failures) {
  for (int world = 10; world < 30; ++world) {
    Row row{variant, "w" + std::to_string(world), 1, {}, {}};
    row.outcome.ending = world - 10 < failures ? Ending::collision : Ending::success;
    rows.push_back(row);
  }
}

}  // namespace

TEST_CASE("a clear difference between two variants is called established", "[batch]") {
  std::vector<Row> rows;
  add(rows, "bad", 15);
  add(rows, "good", 0);
  const std::string text = summary_text(rows);
  CHECK_THAT(text, Contains("bad: 20 runs, 25.0 % succeed (95 %: ") && Contains(", 15 collision"));
  CHECK_THAT(text, Contains("good: 20 runs, 100.0 % succeed"));
  CHECK_THAT(text, Contains("bad - good, success: -75.0 % (95 %: ") && Contains("), difference established"));
}

TEST_CASE("equal variants, and ones with few runs, are not told apart", "[batch]") {
  std::vector<Row> rows;
  add(rows, "one", 3);
  add(rows, "two", 3);
  CHECK_THAT(summary_text(rows), Contains("one - two, success: 0.0 %") && Contains("not established: "));
  const std::vector<Row> few{rows[0], rows[39]};
  CHECK_THAT(summary_text(few), Contains("one: 1 runs"));
}

TEST_CASE("one variant alone is compared with nothing, and no runs are nothing", "[batch]") {
  std::vector<Row> rows;
  add(rows, "one", 3);
  CHECK(summary_text(rows).find(" - ") == std::string::npos);
  CHECK(summary_text({}).empty());
}
