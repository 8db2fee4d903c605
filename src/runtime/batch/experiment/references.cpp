// SPDX-License-Identifier: LGPL-3.0-or-later
#include "references.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"

namespace orca::batch {
namespace {

constexpr std::string_view kNumberColumn = "world";

std::vector<std::string> cells_of(std::string line) {
  if (line.ends_with('\r')) line.pop_back();
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

template <class Number>
std::optional<Number> number_in(const std::string& cell) {
  Number number{};
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return number;
}

std::optional<std::size_t> place_of(std::string_view name, const std::vector<std::string>& columns) {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

Error no_column(const std::string& file, const std::string& name, const std::vector<std::string>& columns) {
  return fail(Code::not_found, in_quotes(file) + " has no column " + in_quotes(name) + "; it has " +
                                   listed(columns) + xml::did_you_mean(xml::nearest_name(name, columns)));
}

}  // namespace

Result<std::map<std::uint64_t, double>> read_references(const std::string& file, const std::string& column) {
  std::error_code unused;
  if (std::filesystem::is_fifo(file, unused))
    return fail(Code::invalid_argument, in_quotes(file) + " is no regular file");
  std::ifstream lines(file);
  std::string line;
  if (!std::getline(lines, line)) return fail(Code::not_found, in_quotes(file) + " cannot be read");
  const std::vector<std::string> columns = cells_of(line);
  const auto number_at = place_of(kNumberColumn, columns);
  const auto length_at = place_of(column, columns);
  if (!number_at) return no_column(file, std::string(kNumberColumn), columns);
  if (!length_at) return no_column(file, column, columns);
  std::map<std::uint64_t, double> lengths;
  for (std::size_t count = 2; std::getline(lines, line); ++count) {
    const std::vector<std::string> cells = cells_of(line);
    const bool is_whole = cells.size() == columns.size();
    const auto number = is_whole ? number_in<std::uint64_t>(cells[*number_at]) : std::nullopt;
    const auto length = is_whole ? number_in<double>(cells[*length_at]) : std::nullopt;
    if (!number || !length || !std::isfinite(*length) || *length <= 0.0)
      return fail(Code::invalid_argument, in_quotes(file) + ", line " + std::to_string(count) +
                                              ": no number of a world with a length in metres");
    lengths[*number] = *length;
  }
  return lengths;
}

}  // namespace orca::batch
