// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <vector>

namespace orca::hwprobe {

/// Returns an object for people, in lines: its type and its fields, without stamps and what is not known, numbers to four digits, and of
/// long lists how many there are, the range that they cover and which is the smallest.
/// @param xml  the object's text form, as to_xml() gives it.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<std::string> summary(const std::string& xml);

}  // namespace orca::hwprobe
