// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "actions.hpp"
#include "options.hpp"
#include "orca/host/last_words.hpp"

int main(int argc, char** argv) {
  const orca::deployer::Options options = orca::deployer::parse_options({argv + 1, argv + argc});
  orca::log::set_level(options.log_level);
  const orca::host::LastWords last_words(static_cast<int>(orca::deployer::ExitCode::failed_running));
  return static_cast<int>(orca::deployer::act(options));
}
