// SPDX-License-Identifier: LGPL-3.0-or-later
// Codes of the errors in the text form of an object. docs/errors-elsewhere.md explains them, and a test compares the
// two lists. A code never changes its meaning.
#pragma once

#include <optional>
#include <string>

namespace orca::text {

namespace codes {

inline constexpr const char* kWrongType = "T001";
inline constexpr const char* kUnknownField = "T002";
inline constexpr const char* kWrongForm = "T003";
inline constexpr const char* kCount = "T004";
inline constexpr const char* kStrayText = "T005";
inline constexpr const char* kBadValue = "T006";
inline constexpr const char* kUnit = "T007";
inline constexpr const char* kRange = "T008";
inline constexpr const char* kChoice = "T009";
inline constexpr const char* kBackslash = "T010";

}  // namespace codes

// An error in a value that was read.
struct Problem {
  const char* code;
  std::string message;
};

using Verdict = std::optional<Problem>;  // Empty: the value is good.

}  // namespace orca::text
