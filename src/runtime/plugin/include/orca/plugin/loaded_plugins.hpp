// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::plugin {

/// Returns the file of the loaded plugin that contains an address of code or data; null if there is none.
/// @thread  any, also a signal handler.
[[nodiscard]] const char* plugin_at(const void* address) noexcept;

}  // namespace orca::plugin
