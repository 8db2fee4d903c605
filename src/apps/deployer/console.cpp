// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "console.hpp"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "exit_code.hpp"
#include "orca/idl/time.hpp"
#include "stats.hpp"

namespace orca::deployer {

double Console::seconds(const idl::TimeValue& stamp) const {
  return to_seconds(to_time_point(stamp) - start_);
}

void Console::arrived(const idl::Arrived& arrived) {
  std::printf("arrived %s %.3f %.3f %.2f\n", arrived.name().c_str(), arrived.x(), arrived.y(),
              seconds(arrived.stamp()));
  std::fflush(stdout);
}

void Console::contact(const idl::Contact& contact) {
  std::printf("contact %s %.2f\n", contact.robot().c_str(), seconds(contact.stamp()));
  std::fflush(stdout);
}

void Console::ended(const host::RunResult& result) {
  const bool ran = result.outcome != host::RunOutcome::not_started;
  if (stats_ && ran) std::fputs(stats_text(result.counters).c_str(), stderr);
  if (result.trace_hash) std::printf("trace-hash %016" PRIx64 "\n", *result.trace_hash);
  std::fflush(stdout);
}

void Console::abandon(const host::RunResult& result) {
  ended(result);
  std::fflush(nullptr);
  std::_Exit(static_cast<int>(exit_code_of(result.outcome)));
}

}  // namespace orca::deployer
