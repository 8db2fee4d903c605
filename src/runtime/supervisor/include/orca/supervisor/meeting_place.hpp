// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/control_socket.hpp"

namespace orca::supervisor {

/// The place at which a host process can be met by another supervisor: a Unix socket beside that of the system,
/// `<graph>@<process>.orphan`. It is there as long as the process, so that nobody can come too early, but the process answers
/// only while it has no supervisor. docs/adr/0038-adoption.md says what they tell each other.

/// Opens the meeting place of this process. The destructor removes it; remove_meeting_place() does if there is no time for
/// destructors.
/// @errors  already_exists if another process of this name has one; unavailable as ControlSocket::open().
/// @thread  any.
[[nodiscard]] Result<ControlSocket> open_meeting_place(const std::string& system, const std::string& process);

/// Removes the meeting place that this process has opened, if any, while this process is about to end.
/// @thread  any; also in a signal handler.
void remove_meeting_place() noexcept;

/// A process that has a meeting place, connected.
struct Waiting {
  pid_t pid = -1;
  Descriptor pidfd;       ///< Of that very process, if it answers over the connection afterwards.
  Descriptor connection;  ///< It keeps packets apart, as a Channel needs it.
};

/// Connects to the meeting places of all processes of a system, and removes those whose processes are dead.
/// @thread  any.
[[nodiscard]] std::vector<Waiting> connect_to_waiting(const std::string& system);

/// Removes the meeting places of a system whose processes are dead.
/// @thread  any.
void clear_meeting_places(const std::string& system);

/// Returns the names of the systems of this user of which processes have a meeting place, sorted.
/// @thread  any.
[[nodiscard]] std::vector<std::string> waiting_systems();

}  // namespace orca::supervisor
