// SPDX-License-Identifier: GPL-3.0-or-later
#include "table.hpp"

#include <algorithm>
#include <cstdio>
#include <ostream>
#include <string>

namespace orca::bench {
namespace {

// Returns a time with three significant digits and a unit.
std::string time_text(Nanoseconds time) {
  const char* const units[] = {"ns", "us", "ms", "s"};
  int unit = 0;
  for (; time >= 999.5 && unit < 3; ++unit) time /= 1000.0;
  char text[32];
  std::snprintf(text, sizeof text, "%.*f %s", time < 9.995 ? 2 : time < 99.95 ? 1 : 0, time, units[unit]);
  return text;
}

std::string ratio_text(const Row& row) {
  if (!row.ratio()) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.2f%s", *row.ratio(), row.judges_p99() ? " (p99)" : "");
  return text;
}

std::string target_text(const Row& row) {
  if (!row.target) return "";
  const bool time = row.target->of == Row::Target::Of::median;
  char ratio[16];
  std::snprintf(ratio, sizeof ratio, "%.2f", row.target->limit);
  return "<= " + (time ? time_text(row.target->limit) : ratio) + (row.missed() ? " MISSED" : " met");
}

using Line = std::vector<std::string>;

Line line_of(const Row& row) {
  Line line{row.name, time_text(row.subject.median()), time_text(row.subject.p99())};
  const bool compared = !row.reference.empty();
  line.push_back(compared ? row.reference_name : "");
  line.push_back(compared ? time_text(row.reference.median()) : "");
  line.push_back(compared ? time_text(row.reference.p99()) : "");
  line.push_back(ratio_text(row));
  line.push_back(target_text(row));
  return line;
}

// Texts are aligned left, numbers right.
bool is_text_column(std::size_t column) { return column == 0 || column == 3 || column == 7; }

void print(std::ostream& out, const Line& line, const std::vector<std::size_t>& widths) {
  std::string text;
  for (std::size_t column = 0; column < line.size(); ++column) {
    const std::string padding(widths[column] - line[column].size(), ' ');
    text += is_text_column(column) ? line[column] + padding : padding + line[column];
    text += "  ";
  }
  text.erase(text.find_last_not_of(' ') + 1);
  out << text << '\n';
}

}  // namespace

int print_table(std::ostream& out, const std::vector<Row*>& rows) {
  std::vector<Line> lines{
      {"per operation", "median", "p99", "beside it", "median", "p99", "ratio", "target"}};
  int missed = 0;
  for (const Row* row : rows) {
    if (row->subject.empty()) continue;
    lines.push_back(line_of(*row));
    missed += row->missed() ? 1 : 0;
  }
  std::vector<std::size_t> widths(lines.front().size());
  for (const Line& line : lines)
    for (std::size_t column = 0; column < line.size(); ++column)
      widths[column] = std::max(widths[column], line[column].size());
  for (const Line& line : lines) print(out, line, widths);
  return missed;
}

}  // namespace orca::bench
