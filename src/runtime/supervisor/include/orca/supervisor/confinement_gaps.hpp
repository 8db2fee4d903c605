// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca::supervisor {

/// Returns from what host processes are kept where the kernel can do it, and not here, as a list for people; empty: nothing. See
/// docs/security.md.
/// @thread  any.
[[nodiscard]] std::string confinement_gaps();

}  // namespace orca::supervisor
