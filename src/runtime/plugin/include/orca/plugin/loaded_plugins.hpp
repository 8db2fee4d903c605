// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::plugin {

/// The file of the plugin that an address lies in, be it code or data; null: none of those that are loaded.
/// @thread  any, also a signal handler.
[[nodiscard]] const char* plugin_at(const void* address) noexcept;

}  // namespace orca::plugin
