// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "orca/base/time.hpp"

namespace orca {

/// Returns `text` with its middle left out if it has more than `most` bytes: "abc...(15000000 bytes)...xyz".
/// Characters stay whole.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most);

/// Returns `text` for one line of a terminal: what is no UTF-8 and every character that a terminal or an editor
/// obeys instead of showing it (control characters, line separators, changes of the writing direction) is written
/// as an escape sequence: `\n`, `\x1b`, `\u202e`.
[[nodiscard]] std::string printable(std::string_view text);

/// Returns as much of `text` as fits into so many columns of a terminal, with "..." at the end if something is left
/// out. Characters stay whole. Each character that may be wide counts as two columns.
/// @param text  printable().
[[nodiscard]] std::string fitting(std::string_view text, std::size_t columns);

/// `text` between double quotes, as messages show what they found; shortened to 300 bytes. Nothing is escaped.
[[nodiscard]] std::string in_quotes(std::string_view text);
/// Returns the text as one word of a shell's command.
[[nodiscard]] std::string in_shell_quotes(std::string_view text);

/// The parts one after the other, with `separator` between them.
[[nodiscard]] std::string joined(std::span<const std::string> parts, std::string_view separator);

/// "a, b, c" for people; "nothing" if there are no names, "a, b and 3 more" if there are more than `most`. Each name
/// is shortened to 200 bytes.
[[nodiscard]] std::string listed(std::span<const std::string> names, std::size_t most = 20);

/// A span of time for people, in seconds to three digits: "5 s", "0.2 s".
[[nodiscard]] std::string seconds_text(Duration time);

}  // namespace orca
