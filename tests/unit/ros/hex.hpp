// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace orca::test {

/// Returns bytes as text, in groups of four.
inline std::string hex(const std::vector<std::byte>& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    char digits[4];
    std::snprintf(digits, sizeof digits, "%s%02x", i > 0 && i % 4 == 0 ? " " : "",
                  std::to_integer<unsigned>(bytes[i]));
    text += digits;
  }
  return text;
}

}  // namespace orca::test
