// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "orca/xml/rules.hpp"
#include "task.hpp"

namespace orca::tasks {

/// The codes of everything that can be wrong with a task file. README.md explains them to people. A code keeps its meaning for ever.
namespace codes {
inline constexpr const char* kWrongRoot = "K001";
inline constexpr const char* kUnknownElement = "K002";
inline constexpr const char* kMisplacedElement = "K003";
inline constexpr const char* kUnknownAttribute = "K004";
inline constexpr const char* kMissing = "K005";
inline constexpr const char* kStrayText = "K006";
inline constexpr const char* kBadValue = "K007";
inline constexpr const char* kNoSteps = "K008";
inline constexpr const char* kCondition = "K009";
inline constexpr const char* kPlace = "K010";
inline constexpr const char* kTwoDrivers = "K011";
inline constexpr const char* kHandlers = "K012";
inline constexpr const char* kNeverEnds = "K013";
inline constexpr const char* kRight = "K014";
}  // namespace codes

extern const xml::ElementRule kTaskRule;
extern const xml::FileRules kTaskFile;

/// Returns the kind of step that an element is. @pre  it is one
[[nodiscard]] Kind kind_of(std::string_view element);

}  // namespace orca::tasks
