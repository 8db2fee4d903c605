// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace orca::test {

/// A file that `deployer --record` has written.
class RecordTable {
 public:
  /// A row: its fields by the names of their columns, empty ones left out.
  using Row = std::map<std::string, std::string>;

  explicit RecordTable(const std::string& path);

  /// Returns the rows of a port, in the order of the run.
  [[nodiscard]] std::vector<Row> rows(const std::string& port) const;

 private:
  std::vector<Row> rows_;
};

/// Returns a field as a number. @pre  it is one.
[[nodiscard]] double number(const RecordTable::Row& row, const std::string& column);

/// Returns the fields column[0], column[1] and so on, as far as there are any.
[[nodiscard]] std::vector<double> numbers(const RecordTable::Row& row, const std::string& column);

}  // namespace orca::test
