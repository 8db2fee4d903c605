// SPDX-License-Identifier: LGPL-3.0-or-later
// The codes of everything that can be wrong with the text form of an object. docs/errors.md explains them to
// people; a test compares the two. A code keeps its meaning for ever.
#pragma once

namespace orca::text::codes {

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

}  // namespace orca::text::codes
