// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "orca/supervisor/record.hpp"

namespace orca::orcactl {

/// Returns records as tables for people: one table for records with the same names, a line each, numbers flush right.
/// @param columns  of the terminal; the widest texts are cut so that lines fit. 0: nothing is cut.
[[nodiscard]] std::string table_text(std::span<const supervisor::Record> records, std::size_t columns);

/// Returns records as a JSON array.
[[nodiscard]] std::string table_json(std::span<const supervisor::Record> records);

/// Returns a record as one line of JSON.
[[nodiscard]] std::string record_json(const supervisor::Record& record);

/// Returns the number of columns of the terminal that is stdout; 0 if it is none.
[[nodiscard]] std::size_t terminal_columns();

/// Writes text to stdout at once, so that whoever reads a pipe sees it.
void print(const std::string& text);

}  // namespace orca::orcactl
