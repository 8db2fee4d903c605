// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "console.hpp"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "exit_code.hpp"
#include "figures.hpp"
#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/time.hpp"
#include "orca/xml/number.hpp"
#include "stats.hpp"
#include "streams.hpp"

namespace orca::deployer {
double Console::seconds(const idl::TimeValue& stamp) const {
  return to_seconds(to_time_point(stamp) - start_);
}

// Returns the end of a line about a robot: its name, if there are others.
std::string Console::ending(const std::string& robot) const {
  return robots_.several() && !robot.empty() ? " " + robot + "\n" : "\n";
}

void Console::built(const host::RunView& view) {
  if (progress_ && stderr_can_live()) progress_line_.emplace(view);
}

void Console::arrived(const idl::Arrived& arrived) {
  write_out("arrived " + arrived.name() + " " + fixed(arrived.x(), 3) + " " + fixed(arrived.y(), 3) + " " +
            fixed(seconds(arrived.stamp()), 2) + ending(robots_.of(arrived.origin())));
}

void Console::goal_failed(const idl::GoalFailed& failed) {
  write_out("failed " + failed.name() + " " + printable(failed.reason()) +
            ending(robots_.of(failed.origin())));
}

void Console::contact(const idl::Contact& contact) {
  write_out("contact " + contact.robot() + " " + fixed(seconds(contact.stamp()), 2) +
            ending(contact.robot()));
}

void Console::ended(const host::RunResult& result) {
  progress_line_.reset();
  name_what_did_not_come(result);
  if (result.outcome != host::RunOutcome::not_started) std::fputs(closing_text(result).c_str(), stderr);
  if (!result.trace_hash) return;
  char line[32];
  std::snprintf(line, sizeof line, "trace-hash %016" PRIx64 "\n", *result.trace_hash);
  write_out(line);
}

// Who rehearses a failure must not take its absence for a robot that copes with it.
void Console::name_what_did_not_come(const host::RunResult& result) const {
  if (result.outcome == host::RunOutcome::not_started || result.outcome == host::RunOutcome::bad_options)
    return;
  const Duration length = result.end - result.start;
  for (const Planned& one : planned_)
    if (one.at >= length)
      log::warning("deployer", one.what + " at " + xml::number_text(to_seconds(one.at)) +
                                   " s did not come: the run ended after " + fixed(to_seconds(length), 2) +
                                   " s");
}

std::string Console::closing_text(const host::RunResult& result) const {
  const std::string summary =
      progress_ ? summary_text(result, std::chrono::steady_clock::now() - wall_start_) : "";
  if (stats_) return stats_text(result.counters) + summary;
  return progress_ ? summary + trouble_text(result.counters) : "";
}

void Console::abandon(const host::RunResult& result) {
  ended(result);
  std::fflush(nullptr);
  std::_Exit(exit_status(exit_code_of(result.outcome)));
}

}  // namespace orca::deployer
