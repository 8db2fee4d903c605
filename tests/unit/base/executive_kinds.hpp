// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "case_in.hpp"
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

/// Returns the back ends in steady time.
inline std::vector<ExecutiveOptions> steady_kinds() {
  std::vector<ExecutiveOptions> kinds = all_kinds();
  std::erase_if(kinds, [](const ExecutiveOptions& kind) { return kind.clock != ClockKind::steady; });
  return kinds;
}

inline std::unique_ptr<Executive> make(const ExecutiveOptions& options) {
  return make_executive(options).value();
}

/// Runs `body` as the main task of an executive of each kind, one after the other.
inline void on_each(const std::vector<ExecutiveOptions>& kinds, const std::function<void(Executive&)>& body) {
  for (const ExecutiveOptions& kind : kinds) {
    const auto executive = make(kind);
    executive->run([&] { body(*executive); });
  }
}
inline void on_all(const std::function<void(Executive&)>& body) { on_each(all_kinds(), body); }
inline void in_steady_time(const std::function<void(Executive&)>& body) { on_each(steady_kinds(), body); }
inline void in_virtual_time(const std::function<void(Executive&)>& body) { on_each(virtual_kinds(), body); }

}  // namespace orca::test

/// A test case that runs on_all(), in_steady_time() or in_virtual_time(); its body has the `executive`.
#define EXECUTIVE_CASE(run, title, tags) CASE_IN(run, (Executive & executive), title, tags)
