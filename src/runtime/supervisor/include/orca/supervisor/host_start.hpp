// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orca::supervisor {

inline constexpr std::size_t kFirstKept = 4;  ///< After the standard streams and the control channel.
inline constexpr std::size_t kMostKept = 6;   ///< Descriptors.

/// How a host process is started. A plain value.
struct HostStart {
  std::string name;                    ///< Of the process in the graph.
  std::string program;                 ///< Path of the program.
  std::vector<std::string> arguments;  ///< What main() gets, from argv[0] on.
  /// Limit of private writable memory [bytes]. The system counts what is reserved, not what is used: a thread's stack
  /// counts in full (8 MiB by default). None: no limit.
  std::optional<std::uint64_t> data_limit;
  std::vector<int> processors;  ///< Those that it may use; empty: all that the supervisor may use.
  int priority = 0;             ///< Of SCHED_FIFO, 1 to 99; 0: the normal scheduler.
  bool shares_input = false;    ///< Its stdin is that of the supervisor; otherwise it is /dev/null.
  /// Where it may write besides devices and temporary files: files, and folders with all below them. The kernel keeps it from other
  /// places if it can (docs/security.md).
  std::vector<std::string> writable{};
  /// Descriptors of the supervisor that it gets, too: as numbers from kFirstKept on, in this order. At most kMostKept.
  std::vector<int> kept{};
};

}  // namespace orca::supervisor
