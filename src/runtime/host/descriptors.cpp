// SPDX-License-Identifier: LGPL-3.0-or-later
#include "descriptors.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

namespace orca {

int count_descriptors() {
  std::error_code unused;
  const std::filesystem::directory_iterator open("/proc/self/fd", unused);
  return static_cast<int>(std::distance(begin(open), end(open))) -
         1;  // without the one that reads the folder
}

void OwnDescriptors::remember() {
  release();
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(fd, F_GETFD) >= 0) own_.push_back(fd);
  extra_ = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (extra_ >= 0) own_.push_back(extra_);
}

void OwnDescriptors::release() {
  own_.clear();
  if (extra_ >= 0) close(extra_);
  extra_ = -1;
}

bool OwnDescriptors::all_open() const {
  return std::ranges::all_of(own_, [](int fd) { return fcntl(fd, F_GETFD) >= 0; });
}

int OwnDescriptors::lowest_free() const {
  const int found = fcntl(extra_, F_DUPFD_CLOEXEC, 0);
  if (found >= 0) close(found);
  return found;
}

}  // namespace orca
