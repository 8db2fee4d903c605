// SPDX-License-Identifier: GPL-3.0-or-later
#include "record_table.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace orca::test {
namespace {

// Of a line without quotation marks.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

}  // namespace

RecordTable::RecordTable(const std::string& path) {
  std::ifstream file(path);
  INFO(path);
  std::string line;
  REQUIRE(std::getline(file, line));
  const std::vector<std::string> names = fields_of(line);
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = fields_of(line);
    Row row;
    for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i)
      if (!fields[i].empty()) row[names[i]] = fields[i];
    rows_.push_back(std::move(row));
  }
}

std::vector<RecordTable::Row> RecordTable::rows(const std::string& port) const {
  std::vector<Row> found;
  std::ranges::copy_if(rows_, std::back_inserter(found),
                       [&](const Row& row) { return row.contains("port") && row.at("port") == port; });
  return found;
}

double number(const RecordTable::Row& row, const std::string& column) {
  CAPTURE(column);
  REQUIRE(row.contains(column));
  char* end = nullptr;
  const double value = std::strtod(row.at(column).c_str(), &end);
  REQUIRE(*end == '\0');
  return value;
}

std::vector<double> numbers(const RecordTable::Row& row, const std::string& column) {
  std::vector<double> values;
  for (std::size_t i = 0; row.contains(column + "[" + std::to_string(i) + "]"); ++i)
    values.push_back(number(row, column + "[" + std::to_string(i) + "]"));
  return values;
}

}  // namespace orca::test
