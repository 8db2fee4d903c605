// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>

#include "orca/idl/motion.hpp"

namespace orca::test {

/// Returns a command of 0.3 m/s with this number.
[[nodiscard]] inline ObjectRef numbered_command(std::uint64_t seq) {
  auto made = head(0.1, 0.3);
  made->seq(seq);
  return ObjectLoan(std::move(made)).seal();
}

}  // namespace orca::test
