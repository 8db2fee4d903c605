// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

namespace orca::apps {

/// Writes out what a program has said on standard output, at its end.
/// @return whether all of it has arrived; if not, standard error says why.
[[nodiscard]] bool output_has_arrived();

}  // namespace orca::apps
