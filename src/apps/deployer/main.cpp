// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "actions.hpp"
#include "options.hpp"
#include "orca/host/last_words.hpp"
#include "streams.hpp"

using orca::deployer::ExitCode;

#if defined(__SANITIZE_ADDRESS__)
// Fontconfig, which pictures use, keeps its configuration in memory until the process ends.
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
#endif

int main(int argc, char** argv) {
  orca::deployer::prepare_streams();
  const orca::host::LastWords last_words(static_cast<int>(ExitCode::failed_running),
                                         static_cast<int>(ExitCode::could_not_start));
  const orca::deployer::Options options = orca::deployer::parse_options({argv + 1, argv + argc});
  orca::log::set_level(options.log_level);
  return orca::deployer::exit_status(orca::deployer::act(options));
}
