// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/image.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "orca/base/files/trusted_code.hpp"

namespace orca::plugin {
namespace {

namespace fs = std::filesystem;

constexpr int kUnchangeable = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL;

Error system_error(const std::string& file) {
  const Code code = errno == ENOENT ? Code::not_found : Code::unavailable;
  return fail(code, "the plugin cannot be copied: " + std::generic_category().message(errno), file);
}

// Returns a name that no image of this machine has: a name in a memory map must say which one it is.
std::string next_name(const std::string& file) {
  static std::atomic<std::uint64_t> made{0};
  return "orca:" + fs::path(file).filename().string().substr(0, 150) + "#" + std::to_string(getpid()) + "." +
         std::to_string(++made);
}

bool copy_all(int from, int to) {
  for (;;) {
    const ssize_t copied = sendfile(to, from, nullptr, 1 << 20);
    if (copied == 0) return true;
    if (copied < 0 && errno != EINTR) return false;
  }
}

}  // namespace

Result<PluginImage> PluginImage::copy(const std::string& file) {
  const Descriptor from(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!from) return system_error(file);
  struct stat status {};
  if (fstat(from.number(), &status) == 0 && !S_ISREG(status.st_mode))
    return fail(Code::not_found, "there is no such plugin: it is no file", file);
  if (const Status trusted = check_trusted_code(file); !trusted.ok())
    return fail(trusted.error().code, "is not loaded: " + trusted.error().message, file);
  Descriptor bytes(memfd_create(next_name(file).c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!bytes || !copy_all(from.number(), bytes.number()) ||
      fcntl(bytes.number(), F_ADD_SEALS, kUnchangeable) != 0)
    return system_error(file);
  return PluginImage(std::move(bytes), fs::absolute(file).lexically_normal().string());
}

std::string PluginImage::mapped_name() const {
  std::error_code unused;
  return fs::read_symlink(path(), unused).string();
}

}  // namespace orca::plugin
