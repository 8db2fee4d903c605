// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orca::test {

/// Returns how often this process has taken memory from the heap with operator new, in any thread and
/// library. It links in its own operator new and delete.
[[nodiscard]] long allocations();

}  // namespace orca::test
