// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "document.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// Adds what was declared before the first run, and each change since then with its date. Nothing if nothing was kept.
/// @param declarations  the earliest first.
void add_declarations(std::vector<Declaration> declarations, Document& document);

/// Returns numbers as ranges, "1-5 9".
[[nodiscard]] std::string ranges_text(const std::vector<std::uint64_t>& numbers);

}  // namespace orca::batch
