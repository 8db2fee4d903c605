// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "orca/plugin/index.hpp"

namespace orca::deployer {

/// Returns the text that `--types` prints: a line for each type, "orca.Goto  component  FILE.so  What it is."
/// Of object types those are there that are not Orca's own.
[[nodiscard]] std::string types_text(const plugin::PluginIndex& index);
/// Returns the same for programs: [{type, kind, file, text}].
[[nodiscard]] std::string types_json(const plugin::PluginIndex& index);

/// Returns the type that a person most likely meant by a name, as the end of a message: `; did you mean "orca.Goto"?`, or
/// nothing. The name may lack the part before the last dot.
[[nodiscard]] std::string hint_at_type(const std::string& name, const plugin::PluginIndex& index);

}  // namespace orca::deployer
