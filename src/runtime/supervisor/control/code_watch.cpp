// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/code_watch.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <csignal>

#include "orca/base/descriptor.hpp"

namespace orca::supervisor {
namespace {

constexpr std::chrono::milliseconds kSettled{100};

// Returns whether somebody has the file open to write it: the system refuses a lease on it then. A linker writes a library in
// its place, the head last, and may pause meanwhile. False where the system gives no leases, or none on a file of others.
bool is_being_written(const std::string& file) {
  const Descriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!descriptor) return false;
  // Whoever opens the file to write it while the lease is held causes a signal, by default one that ends the process.
  if (fcntl(descriptor.number(), F_SETSIG, SIGURG) != 0) return false;
  if (fcntl(descriptor.number(), F_SETLEASE, F_RDLCK) != 0) return errno == EAGAIN;
  (void)fcntl(descriptor.number(), F_SETLEASE, F_UNLCK);
  return false;
}

}  // namespace

std::vector<std::string> CodeWatch::changed(const std::set<std::string>& files, Moment now) {
  std::vector<std::string> all;
  for (const std::string& file : files) {
    const std::optional<Identity> identity = identity_of(file);
    const auto [known, is_new] = files_.try_emplace(file, File{identity, identity, now});
    if (!is_new && has_changed(file, known->second, identity, now)) all.push_back(file);
  }
  return all;
}

std::optional<CodeWatch::Identity> CodeWatch::identity_of(const std::string& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return Identity{static_cast<std::int64_t>(status.st_dev), static_cast<std::int64_t>(status.st_ino),
                  status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

bool CodeWatch::has_changed(const std::string& name, File& file, const std::optional<Identity>& identity,
                            Moment now) {
  if (identity != file.seen) {
    file.seen = identity;
    file.since = now;
  }
  if (!identity || identity == file.known || now - file.since < kSettled) return false;
  if (is_being_written(name)) return false;
  file.known = identity;
  return true;
}

}  // namespace orca::supervisor
