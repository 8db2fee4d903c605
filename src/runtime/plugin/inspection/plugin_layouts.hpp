// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orca::plugin {

/// Returns the layouts of everything that a plugin compiles in, as this process was built: "TYPE HASH" for
/// each type, each ended by a zero.
[[nodiscard]] std::string_view our_layouts();

/// Returns which types a plugin was built for in another layout, with both hashes, or that it has no list of
/// them; nothing if it fits. Types that only this process has do not matter.
///
/// @param theirs, ours  lists as returned by our_layouts(); theirs is not trusted.
/// @param hash          hash of theirs, from the plugin's manifest; nothing: the library has no manifest.
[[nodiscard]] std::optional<std::string> layout_fault(std::string_view theirs,
                                                      std::optional<std::uint64_t> hash,
                                                      std::string_view ours);

/// Returns the hash of a list of layouts, as list_layouts.py computes it.
[[nodiscard]] std::uint64_t hash_of_layouts(std::string_view layouts);

}  // namespace orca::plugin
