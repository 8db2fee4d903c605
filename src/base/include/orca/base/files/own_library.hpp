// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca {

/// Returns the path of a library that lies beside this one, for dlopen(). The loader would find it by name, but not under the
/// sanitizers, which stand between the caller and the loader.
[[nodiscard]] std::string beside_own_library(const std::string& name);

}  // namespace orca
