// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orca/idl/value.hpp"
#include "problem.hpp"

namespace orca::text {

// Whether a value is one attribute in XML (true) or an element or several of them (false).
[[nodiscard]] bool is_attribute(const Value& value);

// Whether a value is the default: 0 (not -0), false, empty, the first enumerator, an array or struct of
// these.
[[nodiscard]] bool is_default(const Value& value);

// A value that is an attribute, as text that XML can hold once its special characters are escaped.
[[nodiscard]] std::string plain_text(const Value& value);

// The way back. `unit`: that of the field. A value that is wrong leaves the object's as it was, a wrong list
// leaves it anyhow.
[[nodiscard]] Verdict read_plain(std::string_view text, std::string_view unit, const Value& value);

}  // namespace orca::text
