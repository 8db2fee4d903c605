// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "orca/base/executive.hpp"

namespace orca::test {

#if defined(__SANITIZE_THREAD__)
inline constexpr bool kFibersWork = false;  // TSan does not follow fibers; batons take their place
#else
inline constexpr bool kFibersWork = true;
#endif

/// Returns every back end with every clock that it has.
inline std::vector<ExecutiveOptions> all_kinds() {
  std::vector<ExecutiveOptions> kinds{{ClockKind::steady, Backend::thread},
                                      {ClockKind::steady, Backend::thread, 50us},
                                      {ClockKind::steady, Backend::baton},
                                      {ClockKind::virtual_time, Backend::baton}};
  if (kFibersWork) {
    kinds.push_back({ClockKind::steady, Backend::fiber});
    kinds.push_back({ClockKind::steady, Backend::fiber, 50us});
    kinds.push_back({ClockKind::virtual_time, Backend::fiber});
  }
  return kinds;
}

/// Returns the back ends in virtual time.
inline std::vector<ExecutiveOptions> virtual_kinds() {
  std::vector<ExecutiveOptions> kinds{{ClockKind::virtual_time, Backend::baton}};
  if (kFibersWork) kinds.push_back({ClockKind::virtual_time, Backend::fiber});
  return kinds;
}

inline std::unique_ptr<Executive> make(const ExecutiveOptions& options) {
  return make_executive(options).value();
}

}  // namespace orca::test
