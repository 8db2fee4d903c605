// SPDX-License-Identifier: GPL-3.0-or-later
#include "tapping/figures.hpp"

#include <catch2/catch.hpp>

using namespace orca::orcactl;
using orca::supervisor::Cell;
using orca::supervisor::Record;
using orca::supervisor::Tapped;

namespace {

constexpr std::uint64_t kMs = 1'000'000;

Tapped passed(std::uint64_t at_ms, std::uint64_t age_ms, std::uint64_t lost = 0) {
  Tapped word;
  word.passed = at_ms * kMs;
  word.created = (at_ms - age_ms) * kMs;
  word.lost = lost;
  return word;
}

std::string value(const Record& record, const std::string& name) {
  for (const Cell& cell : record)
    if (cell.name == name) return cell.value;
  return "missing";
}

}  // namespace

TEST_CASE("rates count what was left out, and times between objects", "[orcactl]") {
  PassedFigures figures;
  for (const std::uint64_t at : {1000, 1100, 1250}) figures.add(passed(at, 1, at == 1250 ? 2 : 0));
  const Record record = figures.take_rate(1.0);
  CHECK(value(record, "objects") == "3");
  CHECK(value(record, "per_second") == "5.00");
  CHECK(value(record, "mean_gap_ms") == "125.000");
  CHECK(value(record, "least_gap_ms") == "100.000");
  CHECK(value(record, "largest_gap_ms") == "150.000");
  CHECK(value(record, "left_out") == "2");
  figures.add(passed(1450, 1, 2));
  const Record next = figures.take_rate(1.0);
  CHECK(value(next, "mean_gap_ms") == "200.000");
  CHECK(value(next, "left_out") == "0");
}

TEST_CASE("ages are those at which objects pass", "[orcactl]") {
  PassedFigures figures;
  for (const std::uint64_t age : {3, 1, 2, 40}) figures.add(passed(1000, age));
  const Record record = figures.take_ages();
  CHECK(value(record, "median_ms") == "2.000");
  CHECK(value(record, "largest_ms") == "40.000");
  CHECK(value(figures.take_ages(), "median_ms") == "");
}
