// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "problem.hpp"

namespace orca::text {

// Returns an instant in seconds, exact to the nanosecond: "12.05".
[[nodiscard]] std::string instant_text(std::int64_t ns);

// Reads an instant: "12.05", "12.05 s" and "-0.000000001" exactly; "50 ms" and "1e3 s" to the nearest
// nanosecond.
[[nodiscard]] Verdict read_instant(std::string_view text, std::int64_t& ns);

}  // namespace orca::text
