// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "actions.hpp"
#include "common/arithmetic.hpp"
#include "options.hpp"
#include "orca/host/last_words.hpp"
#include "processes.hpp"
#include "streams.hpp"

using orca::deployer::ExitCode;

#if defined(__SANITIZE_ADDRESS__)
// Fontconfig, which pictures use, keeps its configuration in memory until the process ends.
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
#endif

namespace {

// Returns whether the run's bits may not depend on the processor.
bool runs_in_virtual_time(const orca::deployer::Options& options) {
  return options.action == orca::deployer::Options::Action::run &&
         options.run.executive.clock == orca::ClockKind::virtual_time && !options.problems.has_errors();
}

}  // namespace

int main(int argc, char** argv) {
  if (orca::deployer::is_host_process(argc, argv)) return orca::deployer::be_host_process(argc, argv);
  const orca::deployer::Options options = orca::deployer::parse_options({argv + 1, argv + argc});
  if (runs_in_virtual_time(options)) orca::apps::choose_portable_arithmetic(argv);
  orca::deployer::prepare_streams();
  const orca::host::LastWords last_words(static_cast<int>(ExitCode::failed_running),
                                         static_cast<int>(ExitCode::could_not_start));
  orca::log::set_level(options.log_level);
  return orca::deployer::exit_status(orca::deployer::act(options));
}
