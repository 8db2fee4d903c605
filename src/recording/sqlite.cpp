// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sqlite.hpp"

#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>

namespace orca::recording {
namespace {

// Returns the name of a file as a URI, by which SQLite can be told that nobody writes it.
std::string uri_of(const std::string& path) {
  std::error_code unused;
  const std::string whole = std::filesystem::absolute(path, unused).string();
  std::string uri = "file://";
  for (const char c : whole) {
    const auto byte = static_cast<unsigned char>(c);
    std::array<char, 4> code{};
    if (c != '/' && c != '.' && c != '_' && c != '-' && std::isalnum(byte) == 0) {
      std::snprintf(code.data(), code.size(), "%%%02X", byte);
      uri += code.data();
    } else {
      uri += c;
    }
  }
  return uri + "?mode=ro&immutable=1";
}

}  // namespace

Result<Database> open_read_only(const std::string& path, std::size_t largest) {
  sqlite3* opened = nullptr;
  const int state = sqlite3_open_v2(uri_of(path).c_str(), &opened,
                                    SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_FULLMUTEX, nullptr);
  Database database(opened);
  if (state != SQLITE_OK)
    return fail(Code::invalid_argument,
                "SQLite cannot open the file: " +
                    std::string(opened == nullptr ? sqlite3_errstr(state) : sqlite3_errmsg(opened)),
                path);
  for (const int off :
       {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW})
    (void)sqlite3_db_config(opened, off, 0, nullptr);
  (void)sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  (void)sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(largest));
  (void)sqlite3_limit(opened, SQLITE_LIMIT_ATTACHED, 0);
  // What is mapped would end the process if somebody cut the file off.
  (void)sqlite3_exec(opened,
                     "PRAGMA mmap_size=0; PRAGMA temp_store=MEMORY; PRAGMA query_only=ON; "
                     "PRAGMA cell_size_check=ON;",
                     nullptr, nullptr, nullptr);
  return database;
}

Statement::Statement(sqlite3* database, const char* text) {
  sqlite3_stmt* made = nullptr;
  state_ = sqlite3_prepare_v2(database, text, -1, &made, nullptr);
  statement_.reset(made);
}

void Statement::ask_for(std::int64_t number) {
  (void)sqlite3_reset(statement_.get());
  (void)sqlite3_bind_int64(statement_.get(), 1, number);
}

bool Statement::step() {
  if (statement_ == nullptr) return false;
  state_ = sqlite3_step(statement_.get());
  return state_ == SQLITE_ROW;
}

bool Statement::has_failed() const {
  return state_ != SQLITE_OK && state_ != SQLITE_ROW && state_ != SQLITE_DONE;
}

bool Statement::is_number(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER;
}

std::int64_t Statement::number(int column) const { return sqlite3_column_int64(statement_.get(), column); }

std::string Statement::text(int column) const {
  const auto* const letters = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  const int count = sqlite3_column_bytes(statement_.get(), column);
  return letters == nullptr ? "" : std::string(letters, static_cast<std::size_t>(count));
}

std::optional<std::span<const std::byte>> Statement::bytes(int column) const {
  if (sqlite3_column_type(statement_.get(), column) != SQLITE_BLOB) return std::nullopt;
  const auto* const first = static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), column));
  return std::span(first, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)));
}

}  // namespace orca::recording
