// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::batch {

/// The most numbers that a list may have.
inline constexpr std::size_t kMostNumbers = 1'000'000;

/// Reads numbers and ranges with blanks between them: "1-20 50".
/// @return each number once, in the order of the text.
/// @errors  invalid_argument with what is wrong: no number, a range that goes down, a number given twice, too many.
[[nodiscard]] Result<std::vector<std::uint64_t>> read_number_list(std::string_view text);

}  // namespace orca::batch
