// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca::xml {

/// Returns the text of a file that other programs read and write too, without what XML allows there and read_text() does not
/// read: a byte order mark at the start is taken out; comments and processing instructions become blanks, so that all else keeps
/// its place.
/// @thread  any.
[[nodiscard]] std::string without_extras(std::string text);

}  // namespace orca::xml
