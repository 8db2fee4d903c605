// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace orca {

/// `text` between double quotes, as messages show what they found. Nothing is escaped.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The parts one after the other, with `separator` between them.
[[nodiscard]] std::string joined(std::span<const std::string> parts, std::string_view separator);

/// "a, b, c" for people; "nothing" if there are no names, "a, b and 3 more" if there are more than `most`.
[[nodiscard]] std::string listed(std::span<const std::string> names, std::size_t most = 20);

}  // namespace orca
