// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/host_start.hpp"

namespace orca::supervisor {

inline constexpr int kChannelNumber = 3;  // the number of the control channel in a host process

/// A process that has been started.
struct Launched {
  pid_t pid = -1;
  Descriptor pidfd;
  Descriptor output;                  ///< The end of a pipe from its stdout and stderr; reading never waits.
  std::vector<std::string> warnings;  ///< What the system has refused.
};

/// Starts a program as a host process. Returns when the new program runs.
/// @param channel  the process's end of the control channel.
/// @errors  as HostProcess::start().
[[nodiscard]] Result<Launched> launch(const HostStart& start, const Descriptor& channel);

}  // namespace orca::supervisor
