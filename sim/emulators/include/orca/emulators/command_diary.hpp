// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace orca::emulators {

/// Adds the number of a command to those that a device has got, for whoever watches it. Of very many the older half is forgotten,
/// because an emulation may run for weeks.
inline void note_command(std::vector<int>& commands, int command) {
  constexpr std::size_t kMostKept = 10'000;
  if (commands.size() >= kMostKept)
    commands.erase(commands.begin(), commands.begin() + static_cast<std::ptrdiff_t>(kMostKept / 2));
  commands.push_back(command);
}

}  // namespace orca::emulators
