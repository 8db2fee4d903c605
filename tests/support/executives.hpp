// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case_in.hpp"
#include "orca/base/executive.hpp"

namespace orca::test {

/// Returns every kind of executive that works in this build. Under ThreadSanitizer those on fibers are left
/// out, and the reason is printed once.
[[nodiscard]] std::vector<ExecutiveOptions> all_executives();

/// Returns those of them with a virtual clock.
[[nodiscard]] std::vector<ExecutiveOptions> virtual_executives();

/// Returns those of them with the steady clock.
[[nodiscard]] std::vector<ExecutiveOptions> steady_executives();

/// Returns a name for people: "fiber, virtual".
[[nodiscard]] std::string name_of(const ExecutiveOptions& options);

/// Runs `body` as the main task of a new executive. A failed REQUIRE inside ends the test as usual.
void run_on(const ExecutiveOptions& options, const std::function<void(Executive&)>& body);

/// Runs `body` on each kind of executive, one after the other; a failure names the executive.
void run_on_each(const std::vector<ExecutiveOptions>& kinds, const std::function<void(Executive&)>& body);

/// As run_on_each(), for each kind that works in this build.
inline void on_all_executives(const std::function<void(Executive&)>& body) {
  run_on_each(all_executives(), body);
}

/// Waits until `condition` holds, for at most 5 s. Serves to wait for what another strand will do soon.
///
/// @return whether it holds.
[[nodiscard]] bool eventually(Executive& executive, const std::function<bool()>& condition);

/// Blocks the calling task for a while.
inline void sleep(Executive& executive, Duration time) { executive.sleep_until(executive.now() + time); }

}  // namespace orca::test

/// A test case that runs on each kind of executive, one after the other; its body has `executive`.
#define EXECUTIVE_CASE(title, tags) \
  CASE_IN(orca::test::on_all_executives, (orca::Executive & executive), title, tags)
