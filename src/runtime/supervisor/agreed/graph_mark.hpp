// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "orca/base/hash.hpp"

namespace orca::supervisor {

/// Returns a number by which an expanded graph is told from others.
/// @thread  any.
[[nodiscard]] inline std::uint64_t mark_of(const std::string& expanded) {
  Fnv1a hash;
  hash.add_text(expanded);
  return hash.value();
}

}  // namespace orca::supervisor
