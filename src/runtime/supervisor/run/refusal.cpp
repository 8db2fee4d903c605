// SPDX-License-Identifier: LGPL-3.0-or-later
#include "refusal.hpp"

#include <filesystem>
#include <system_error>

#include "orca/base/log.hpp"

namespace orca::supervisor {

host::RunResult refuse(const Error& error, const std::string& log_name, host::RunListener& listener) {
  log::error(log_name, error.text());
  host::RunResult result;
  result.outcome = host::RunOutcome::not_started;
  result.error = error;
  listener.ended(result);
  return result;
}

Error unreachable(Error why) {
  if (why.code != Code::already_exists)
    why.message =
        "nothing is started, because no emergency stop (orcactl estop) could reach it: " + why.message;
  return why;
}

Status can_start_processes(const SystemFacts& facts) {
  std::error_code error;
  for (const auto& [type, plugin] : facts.plugins)
    if (!plugin.file.empty() && !std::filesystem::exists(plugin.file, error))
      return fail(Code::failed_precondition,
                  plugin.file + ", the plugin of " + type +
                      ", is not there any more, and no process could come up without it; put it back first");
  return ok();
}

}  // namespace orca::supervisor
