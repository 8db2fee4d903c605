// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace orca::text {

// An error in a value that was read.
struct Problem {
  const char* code;
  std::string message;
};

using Verdict = std::optional<Problem>;  // Empty: the value is good.

}  // namespace orca::text
