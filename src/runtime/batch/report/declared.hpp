// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "document.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// Adds what was declared before the first run, and each change since then with its date. Nothing if nothing was kept.
/// @param declarations  the earliest first.
void add_declarations(const std::vector<Declaration>& declarations, Document& document);

}  // namespace orca::batch
