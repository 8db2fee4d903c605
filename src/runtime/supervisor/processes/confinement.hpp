// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/base/system/call_filter.hpp"
#include "orca/supervisor/host_start.hpp"

namespace orca::supervisor {

/// What the kernel keeps a host process from, whatever its code wants (docs/adr/0109-confined-processes.md): system calls that no
/// component needs fail with EPERM (seccomp); files are written only where the start says and in a few places for all; signals,
/// debugging and memory of other processes are out of reach (Landlock).
///
/// Thread contract: not synchronised.
class Confinement {
 public:
  /// Prepares everything. What the kernel lacks is left out.
  /// @throws as launch(), if the system has no descriptor for the rules.
  explicit Confinement(const HostStart& start);

  /// Confines the calling thread and all that it starts, for good.
  /// @return false with errno; nothing else may then be relied on.
  /// @thread  any; it makes system calls only, so that a child may call it between fork and exec.
  [[nodiscard]] bool enter() const noexcept;

 private:
  CallFilter calls_;
  Descriptor rules_;  // of Landlock; empty: the kernel has none
};

}  // namespace orca::supervisor
