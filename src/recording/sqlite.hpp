// SPDX-License-Identifier: LGPL-3.0-or-later
// SQLite, for files of others: nothing is written, and nothing is run that a schema asks for.
#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "orca/base/result.hpp"

namespace orca::recording {

/// Ends what SQLite has begun.
struct SqliteClose {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, SqliteClose>;

/// Opens a database that must not change meanwhile: no lock is taken, and no other file is made or looked at. Values of more than
/// `largest` bytes are not read.
/// @errors  invalid_argument if SQLite cannot open it.
[[nodiscard]] Result<Database> open_read_only(const std::string& path, std::size_t largest);

/// A question to a database, with its answer row by row.
///
/// Thread contract: one thread at a time.
class Statement {
 public:
  Statement(sqlite3* database, const char* text);

  /// Asks again, with another number in place of the mark.
  void ask_for(std::int64_t number);
  /// Goes to the next row. Returns false if there is none.
  bool step();
  /// Returns whether there are no more rows because of an error.
  [[nodiscard]] bool has_failed() const;

  [[nodiscard]] bool is_number(int column) const;
  [[nodiscard]] std::int64_t number(int column) const;
  [[nodiscard]] std::string text(int column) const;
  /// Returns bytes, which stay until the next step; nothing for a value of another kind.
  [[nodiscard]] std::optional<std::span<const std::byte>> bytes(int column) const;

 private:
  std::unique_ptr<sqlite3_stmt, SqliteClose> statement_;
  int state_;
};

}  // namespace orca::recording
