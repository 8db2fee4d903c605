// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thread_state.hpp"

#include <sys/syscall.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

namespace orca::detail {

bool sleeps_in_system(pid_t thread) {
  constexpr std::array kWrites{SYS_write, SYS_pwrite64, SYS_writev, SYS_sendto, SYS_sendmsg};
  // Reads "running", or the number of the system call that the thread is in.
  std::ifstream state("/proc/self/task/" + std::to_string(thread) + "/syscall");
  long call = -1;
  return (state >> call) && call >= 0 && std::ranges::find(kWrites, call) == kWrites.end();
}

}  // namespace orca::detail
