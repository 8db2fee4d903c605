// SPDX-License-Identifier: LGPL-3.0-or-later
#include "descriptors.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace orca {

Descriptors open_descriptors() {
  const char* const folder = "/proc/self/fd";
  std::error_code unused;
  std::vector<std::filesystem::path> entries;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unused)) entries.push_back(entry);
  Descriptors open;
  for (const auto& entry : entries) {
    std::error_code closed;  // the one that read the folder
    const std::filesystem::path target = std::filesystem::read_symlink(entry, closed);
    if (!closed) open.emplace(std::atoi(entry.filename().c_str()), target.native());
  }
  return open;
}

std::string names_of(const Descriptors& descriptors) {
  std::string names;
  for (const auto& [fd, target] : descriptors)
    names += (names.empty() ? "" : ", ") + std::to_string(fd) + " (" + target + ")";
  return names;
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
