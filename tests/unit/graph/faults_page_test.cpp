// SPDX-License-Identifier: GPL-3.0-or-later
// docs/faults.md is true: every class of fault has at least two cases, and they show what the page says.
#include <catch2/catch.hpp>

#include <algorithm>
#include <set>
#include <sstream>

#include "approval.hpp"

namespace fs = std::filesystem;

namespace {

struct Row {
  std::string what;  // the class's number, or its name
  std::vector<std::string> codes;
  std::string cases;

  [[nodiscard]] bool is_for_later() const { return cases.starts_with("later: "); }
  [[nodiscard]] bool is_a_remark() const { return is_for_later() || codes.front() == "-"; }
};

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t at = text.find(separator); at != std::string::npos; at = text.find(separator, begin)) {
    parts.push_back(text.substr(begin, at - begin));
    begin = at + separator.size();
  }
  parts.push_back(text.substr(begin));
  return parts;
}

// The rows of the page's tables; codes and cases are the last two columns.
std::vector<Row> rows() {
  std::istringstream page(orca::test::bytes_of(fs::path(ORCA_SOURCE_DIR) / "docs/faults.md"));
  std::vector<Row> result;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| ") || line.starts_with("| class") || line.starts_with("| what")) continue;
    const auto cells = split(line.substr(2, line.size() - 4), " | ");
    REQUIRE(cells.size() >= 3);
    result.push_back({cells.front(), split(cells[cells.size() - 2], ", "), cells.back()});
  }
  return result;
}

fs::path approved_text(const std::string& name) {
  const fs::path data = fs::path(ORCA_SOURCE_DIR) / "tests/data";
  const std::string file = name + ".expected";
  if (name.starts_with("plugins/") || name.starts_with("configure/")) return data / "graphs" / file;
  if (name.starts_with("worlds/") || name.starts_with("robots/"))
    return data / name.substr(0, 6) / "broken" / file.substr(7);
  return data / "graphs/broken" / file;
}

bool shows_one_of(const std::string& text, const std::vector<std::string>& codes) {
  return std::ranges::any_of(
      codes, [&](const std::string& code) { return text.find(" " + code + ": ") != std::string::npos; });
}

}  // namespace

TEST_CASE("each class of the catalogue is on the page once", "[graph][faults]") {
  std::vector<int> numbers;
  for (const Row& row : rows())
    if (row.what.find_first_not_of("0123456789") == std::string::npos) numbers.push_back(std::stoi(row.what));
  REQUIRE(numbers.size() == 45);
  for (int i = 0; i < 45; ++i) CHECK(numbers[static_cast<std::size_t>(i)] == i + 1);
  CHECK(rows().size() == 45 + 41);
}

TEST_CASE("only classes that need a later part of Orca are left for later", "[graph][faults]") {
  std::set<std::string> later;
  for (const Row& row : rows())
    if (row.is_for_later()) later.insert(row.what);
  CHECK(later == std::set<std::string>{"43"});  // security
}

TEST_CASE("a class that is found elsewhere than in a file names the test that shows it", "[graph][faults]") {
  for (const Row& row : rows()) {
    if (!row.is_a_remark() || row.is_for_later()) continue;
    INFO(row.what << ": " << row.cases);
    const std::size_t at = row.cases.rfind(": ");
    REQUIRE(at != std::string::npos);
    CHECK(fs::is_regular_file(fs::path(ORCA_SOURCE_DIR) / row.cases.substr(at + 2)));
  }
}

TEST_CASE("every class of fault has at least two cases with approved texts that show its code",
          "[graph][faults]") {
  for (const Row& row : rows()) {
    if (row.is_a_remark()) continue;
    const auto cases = split(row.cases, ", ");
    INFO(row.what);
    CHECK(cases.size() >= 2);
    for (const std::string& name : cases) {
      INFO(name);
      REQUIRE(fs::exists(approved_text(name)));
      CHECK(shows_one_of(orca::test::bytes_of(approved_text(name)), row.codes));
    }
  }
}

TEST_CASE("there are at least two hundred approved texts of faults", "[graph][faults]") {
  std::size_t count = 0;
  for (const char* folder : {"graphs/broken", "graphs/plugins", "worlds/broken", "robots/broken"})
    count += orca::test::files_in(fs::path(ORCA_SOURCE_DIR) / "tests/data" / folder, ".expected").size();
  CHECK(count >= 200);
}
