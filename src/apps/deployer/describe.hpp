// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "orca/base/result.hpp"

namespace orca::deployer {

/// What `--describe` prints: the types of a plugin with their ports and parameters.
[[nodiscard]] Result<std::string> describe_plugin(const std::string& path);

}  // namespace orca::deployer
