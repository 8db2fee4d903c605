// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "table.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "orca/base/json.hpp"
#include "orca/base/text.hpp"

namespace orca::orcactl {
namespace {

using supervisor::Cell;
using supervisor::Record;
using Row = std::vector<std::string>;

constexpr std::size_t kGap = 2;        // blanks between two columns
constexpr std::size_t kNarrowest = 8;  // columns of a text that is cut

std::string heading_of(const Cell& cell) {
  std::string heading = cell.name;
  std::ranges::transform(heading, heading.begin(), [](char c) {
    return c == '_' ? ' ' : static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  });
  return heading;
}

constexpr std::size_t kBuildDigits = 12;  // enough to tell builds apart

// People know a plugin by its file's name and a build by its first digits; programs get the whole path and number.
std::string shown(const Cell& cell) {
  const std::string text = printable(cell.value);
  if (cell.name == "build_id") return text.substr(0, kBuildDigits);
  return cell.name == "plugin" ? text.substr(text.rfind('/') + 1) : text;
}

bool have_one_form(const Record& a, const Record& b) {
  return std::ranges::equal(a, b, [](const Cell& x, const Cell& y) { return x.name == y.name; });
}

std::vector<Row> rows_of(std::span<const Record> records) {
  std::vector<Row> rows(1);
  for (const Cell& cell : records.front()) rows.front().push_back(heading_of(cell));
  for (const Record& record : records) {
    Row& row = rows.emplace_back();
    for (const Cell& cell : record) row.push_back(shown(cell));
  }
  return rows;
}

std::vector<std::size_t> widths_of(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  return widths;
}

// Makes the widest texts narrower until everything fits, or nothing can be cut any more.
void fit(std::vector<std::size_t>& widths, const Record& form, std::size_t columns) {
  const auto total = [&] {
    return std::accumulate(widths.begin(), widths.end(), (widths.size() - 1) * kGap);
  };
  while (columns > 0 && total() > columns) {
    std::size_t widest = widths.size();
    for (std::size_t i = 0; i < widths.size(); ++i)
      if (form[i].kind == Cell::Kind::text && (widest == widths.size() || widths[i] >= widths[widest]))
        widest = i;
    if (widest == widths.size() || widths[widest] <= kNarrowest) return;
    --widths[widest];
  }
}

std::string line_of(const Row& row, const std::vector<std::size_t>& widths, const Record& form, bool cuts) {
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::string text = cuts ? fitting(row[i], widths[i]) : row[i];
    const std::string blanks(widths[i] - std::min(widths[i], text.size()), ' ');
    line += (i == 0 ? "" : std::string(kGap, ' '));
    line += form[i].kind == Cell::Kind::number ? blanks + text : text + blanks;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string one_table(std::span<const Record> records, std::size_t columns) {
  const std::vector<Row> rows = rows_of(records);
  std::vector<std::size_t> widths = widths_of(rows);
  fit(widths, records.front(), columns);
  std::string text;
  for (const Row& row : rows) text += line_of(row, widths, records.front(), columns > 0);
  return text;
}

void write(const Cell& cell, JsonWriter& json) {
  json.key(cell.name);
  if (cell.kind == Cell::Kind::text) {
    json.value(cell.value);
  } else if (cell.kind == Cell::Kind::flag) {
    json.value(cell.value == "true");
  } else if (cell.value.empty()) {
    json.value(std::numeric_limits<double>::quiet_NaN());  // written as null
  } else if (cell.value.find_first_of(".eni") == std::string::npos) {
    json.value(std::strtoll(cell.value.c_str(), nullptr, 10));
  } else {
    json.value(std::strtod(cell.value.c_str(), nullptr));
  }
}

void write(const Record& record, JsonWriter& json) {
  json.begin_object();
  for (const Cell& cell : record) write(cell, json);
  json.end();
}

}  // namespace

std::string table_text(std::span<const supervisor::Record> records, std::size_t columns) {
  std::vector<Record> left(records.begin(), records.end());
  std::string text;
  while (!left.empty()) {
    const Record form = left.front();
    const auto others = std::ranges::stable_partition(
        left, [&](const Record& record) { return have_one_form(record, form); });
    const std::vector<Record> of_form(left.begin(), others.begin());
    left.erase(left.begin(), others.begin());
    text += (text.empty() ? "" : "\n") + one_table(of_form, columns);
  }
  return text;
}

std::string table_json(std::span<const Record> records) {
  JsonWriter json;
  json.begin_array();
  for (const Record& record : records) write(record, json);
  json.end();
  return json.text();
}

// A line break in a text is an escape sequence, so all others only make the text pretty.
std::string record_json(const Record& record) {
  JsonWriter json;
  write(record, json);
  std::string line;
  bool begins = false;
  for (const char c : json.text()) {
    if (c == '\n') {
      begins = true;
    } else if (!begins || c != ' ') {
      begins = false;
      line += c;
    }
  }
  return line + "\n";
}

std::size_t terminal_columns() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_col == 0 ? 80 : size.ws_col;
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace orca::orcactl
