// SPDX-License-Identifier: LGPL-3.0-or-later
#include "descriptors.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace orca::host {
namespace {

constexpr std::size_t kNamed = 8;

// Returns the open file behind a descriptor, without its name.
OpenFile file_behind(int fd) {
  struct stat file {};
  if (fstat(fd, &file) != 0) return {};
  return {file.st_dev, file.st_ino};
}

std::string name_of_file_behind(int fd) {
  std::error_code unused;
  return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(fd), unused).native();
}

const char* name_of_stream(int fd) {
  if (fd == STDIN_FILENO) return "stdin";
  return fd == STDOUT_FILENO ? "stdout" : "stderr";
}

}  // namespace

// Names are not asked for: a component that is started or exchanged waits for this. The files are looked at by their entries in
// the folder, not by their descriptors, which other threads open and close meanwhile.
std::optional<Descriptors> open_descriptors() {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir("/proc/self/fd"), closedir);
  if (folder == nullptr) return std::nullopt;
  Descriptors open;
  while (const dirent* const entry = readdir(folder.get())) {
    const int fd = std::atoi(entry->d_name);
    struct stat file {};
    const bool is_number = entry->d_name[0] != '.';
    if (!is_number || fd == dirfd(folder.get()) || fstatat(dirfd(folder.get()), entry->d_name, &file, 0) != 0)
      continue;  // other threads may close theirs
    open[fd] = {file.st_dev, file.st_ino};
  }
  return open;
}

std::string names_of(const Descriptors& descriptors) {
  std::string names;
  std::size_t named = 0;
  for (const auto& [fd, file] : descriptors) {
    if (named == kNamed) return names + " and " + std::to_string(descriptors.size() - named) + " more";
    names += (named++ == 0 ? "" : ", ") + std::to_string(fd) + " (" + name_of_file_behind(fd) + ")";
  }
  return names;
}

void OwnDescriptors::remember() {
  release();
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(fd, F_GETFD) < 0) continue;
    own_.push_back(fd);
    streams_.push_back({fd, fcntl(fd, F_DUPFD_CLOEXEC, kFirstCopy), file_behind(fd)});
  }
  extra_ = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (extra_ >= 0) own_.push_back(extra_);
}

void OwnDescriptors::release() {
  own_.clear();
  for (const Stream& stream : streams_)
    if (stream.copy >= 0) close(stream.copy);
  streams_.clear();
  if (extra_ >= 0) close(extra_);
  extra_ = -1;
}

bool OwnDescriptors::all_open() const {
  return std::ranges::all_of(own_, [](int fd) { return fcntl(fd, F_GETFD) >= 0; });
}

std::string OwnDescriptors::restore_redirected() {
  std::string changes;
  for (Stream& stream : streams_) {
    const OpenFile now = file_behind(stream.fd);
    if (now == stream.file) continue;
    changes += (changes.empty() ? "" : ", ") + std::string(name_of_stream(stream.fd)) + " to " +
               name_of_file_behind(stream.fd);
    if (file_behind(stream.copy) == stream.file && dup2(stream.copy, stream.fd) >= 0) continue;
    changes += ", and the way back is closed";
    stream.file = now;
  }
  return changes;
}

int OwnDescriptors::lowest_free() const {
  const int found = fcntl(extra_, F_DUPFD_CLOEXEC, 0);
  if (found >= 0) close(found);
  return found;
}

}  // namespace orca::host
