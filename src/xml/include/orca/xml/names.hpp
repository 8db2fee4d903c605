// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace orca::xml {

/// Returns the candidate that a person most likely meant by `word`: the one with the fewest inserted,
/// deleted, replaced or swapped characters, where upper and lower case count as equal. If several are equally
/// near, it is the first of them. Failing that, it is the first that begins with the word or that the word
/// begins with.
/// @return nothing if `word` is empty, or every candidate differs in more than about a third of the word's
///         characters and shares no beginning of three or more with it.
/// @source  optimal string alignment distance; Damerau, "A technique for computer detection and correction
///          of spelling errors", CACM 7(3), 1964.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view word,
                                                      std::span<const std::string> candidates);

/// Returns `; did you mean "laser"?`, or nothing: the end of a message about an unknown name.
[[nodiscard]] std::string did_you_mean(const std::optional<std::string>& nearest);

}  // namespace orca::xml
