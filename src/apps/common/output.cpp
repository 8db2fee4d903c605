// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace orca::apps {
namespace {

// Some file systems report a failure only when the file is closed.
bool closes_well() {
  const int copy = dup(STDOUT_FILENO);
  return copy < 0 || close(copy) == 0;
}

}  // namespace

bool output_has_arrived() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && closes_well()) return true;
  std::fprintf(stderr, "error: cannot write to standard output%s%s\n", errno == 0 ? "" : ": ",
               errno == 0 ? "" : std::strerror(errno));
  return false;
}

}  // namespace orca::apps
