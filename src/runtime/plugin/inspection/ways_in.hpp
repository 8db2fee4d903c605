// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orca::plugin {

/// Returns by what the process would enter a part of its memory that is to go: signal handlers, the handlers of C++, the
/// environment and the buffers of C's standard streams. For people: "the handler of SIGUSR1".
///
/// @thread  any, while no other thread changes the same.
[[nodiscard]] std::vector<std::string> ways_into(std::uintptr_t start, std::uintptr_t end);

}  // namespace orca::plugin
