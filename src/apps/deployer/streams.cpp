// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "streams.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "orca/base/live_line.hpp"

namespace orca::deployer {
namespace {

std::atomic<bool> g_output_failed{false};

void note_failure() {
  const int reason = errno;
  if (!g_output_failed.exchange(true))
    std::fprintf(stderr, "error: cannot write to standard output: %s\n", std::strerror(reason));
}

// Some file systems report a failure only when the file is closed.
bool closes_well() {
  const int copy = dup(STDOUT_FILENO);
  return copy < 0 || close(copy) == 0;
}

}  // namespace

void prepare_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // A free number is always the lowest. Neither reading nor writing works on O_PATH.
    if (fcntl(fd, F_GETFD) < 0) (void)!open("/dev/null", O_PATH);
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_IGN);
}

void write_out(std::string_view text) {
  const LiveLine::Pause room;  // stdout may be the same terminal as stderr
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    note_failure();
}

int exit_status(ExitCode status) {
  if (!closes_well()) note_failure();
  const bool lost = status == ExitCode::finished && g_output_failed.load();
  return static_cast<int>(lost ? ExitCode::failed_running : status);
}

}  // namespace orca::deployer
