// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/own_process.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "processes/launch.hpp"

namespace orca::supervisor {
namespace {

// With a limit, memory that is reserved later would be refused although it may never be touched.
bool may_lock_without_limit() {
  const rlimit unlimited{RLIM_INFINITY, RLIM_INFINITY};
  if (setrlimit(RLIMIT_MEMLOCK, &unlimited) == 0) return true;
  rlimit present{};
  return getrlimit(RLIMIT_MEMLOCK, &present) == 0 && present.rlim_cur == RLIM_INFINITY;
}

}  // namespace

Result<Descriptor> take_channel() {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(kChannelNumber, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_SEQPACKET)
    return fail(Code::failed_precondition,
                "this process has no control channel; only the deployer starts host processes");
  fcntl(kChannelNumber, F_SETFD, FD_CLOEXEC);
  return Descriptor(kChannelNumber);
}

void set_process_name(const std::string& name) { prctl(PR_SET_NAME, name.c_str()); }

void die_with_supervisor(bool dies) { prctl(PR_SET_PDEATHSIG, dies ? SIGKILL : 0); }

std::optional<std::string> lock_memory() {
  if (!may_lock_without_limit())
    return "memory is not locked: the system limits locked memory; raise the limit (ulimit -l unlimited)";
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0) return std::nullopt;
  return std::string("memory is not locked: ") + std::strerror(errno);
}

}  // namespace orca::supervisor
