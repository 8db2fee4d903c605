// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/input_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>

#include "orca/base/descriptor.hpp"
#include "orca/base/exhaustion.hpp"
#include "used_files.hpp"

namespace orca {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kLimit{5};

// Waits for more of a pipe or a device; false if the deadline comes first.
bool wait_for_more(int fd, Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  pollfd inputs[] = {{fd, POLLIN, 0}};
  return left > 0 && poll(inputs, std::size(inputs), static_cast<int>(left)) > 0;
}

Error stalled() {
  return fail(Code::deadline_exceeded, "it has given nothing more for a while, and has not ended");
}

Result<std::string> read_all(int fd, std::size_t max_bytes) {
  const Clock::time_point deadline = Clock::now() + kLimit;
  std::string bytes;
  std::array<char, 65536> buffer;
  while (bytes.size() < max_bytes) {
    const ssize_t count = read(fd, buffer.data(), std::min(buffer.size(), max_bytes - bytes.size()));
    if (count == 0) return bytes;
    if (count > 0) {
      bytes.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {
      if (!wait_for_more(fd, deadline)) return stalled();
    } else if (errno != EINTR) {
      return fail(Code::data_loss, std::strerror(errno));
    }
  }
  return bytes;
}

}  // namespace

Result<std::string> read_input_file(const std::string& path, std::size_t max_bytes) {
  // Without O_NONBLOCK, a pipe that nobody writes to would block here for ever.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  struct stat about {};
  if (file.number() < 0 || fstat(file.number(), &about) != 0) {
    const int reason = errno;
    throw_if_exhausted(reason);
    return fail(Code::not_found, std::strerror(reason));
  }
  Result<std::string> bytes = read_all(file.number(), max_bytes);
  if (bytes && bytes->empty() && S_ISFIFO(about.st_mode))
    return fail(Code::data_loss, "it is a pipe that nobody writes to");
  if (bytes && S_ISREG(about.st_mode)) UsedFiles::of_process().add_read(path);
  return bytes;
}

void remember_input_file(const std::string& path) { UsedFiles::of_process().add_named(path); }

std::vector<std::string> known_input_files() { return UsedFiles::of_process().inputs(); }

bool has_been_read(const std::string& path) {
  struct stat file {};
  return stat(path.c_str(), &file) == 0 && UsedFiles::of_process().is_read(file);
}

}  // namespace orca
