// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "orca/xml/rules.hpp"

namespace orca::xml {

/// The reason why a text is not the value that its rule wants.
struct ValueFault {
  enum class Kind { form, unit, range, choice };
  Kind kind = Kind::form;
  std::string message;
};

/// Returns the code that a kind of file gives to such a fault.
[[nodiscard]] const char* code_of(ValueFault::Kind kind, const RuleCodes& codes);

/// Reads a value by its rule; the caller chooses the function that fits the rule's form.
/// @param fault  receives the reason where nothing is returned.
[[nodiscard]] std::optional<bool> read_boolean(std::string_view text, ValueFault& fault);
[[nodiscard]] std::optional<std::int64_t> read_integer(std::string_view text, const ValueRule& rule,
                                                       ValueFault& fault);
/// Returns the value in SI.
[[nodiscard]] std::optional<double> read_number(std::string_view text, const ValueRule& rule,
                                                ValueFault& fault);

}  // namespace orca::xml
