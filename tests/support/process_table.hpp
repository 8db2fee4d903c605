// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "subprocess.hpp"

namespace orca::test {

/// What /proc tells of processes. A process that ends meanwhile counts as one that has nothing.

/// Returns the names of the children of a process, with their numbers. Zombies are left out.
[[nodiscard]] std::map<std::string, pid_t> children_of(pid_t parent);
/// Returns the names of the processes of a group that live. A zombie may have to wait long for a parent that takes note.
[[nodiscard]] std::vector<std::string> living_in_group(pid_t group);
/// Returns whether a process exists. Zombies do not count.
[[nodiscard]] bool is_alive(pid_t process);
[[nodiscard]] std::size_t descriptors_of(pid_t process);
[[nodiscard]] std::size_t threads_of(pid_t process);
/// Returns the CPU time of all threads of a process that still run.
[[nodiscard]] Seconds cpu_time_of(pid_t process);

/// Returns what of Orca a machine keeps although no process may use it: files in /dev/shm, and Unix sockets of the
/// programs that this one has started.
[[nodiscard]] std::vector<std::string> kept_by_system();

}  // namespace orca::test
