// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/files/kept_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "orca/base/descriptor.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/hash.hpp"
#include "orca/base/input_file.hpp"

namespace orca {
namespace {

constexpr std::size_t kMost = 1'000'000'000;  // bytes

std::string head_of(const std::string& kind, std::span<const std::byte> bytes) {
  Fnv1a hash;
  hash.add(bytes);
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, " %zu %016" PRIx64 "\n", bytes.size(), hash.value());
  return "orca " + kind + numbers;
}

Error system_error(const std::string& path) {
  const int reason = errno;
  throw_if_exhausted(reason);
  return fail(Code::unavailable, std::string("cannot be written: ") + std::strerror(reason), path);
}

Status write_all(int file, std::span<const std::byte> bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return system_error(path);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return ok();
}

}  // namespace

Result<std::optional<std::vector<std::byte>>> KeptFile::read() const {
  struct stat found {};
  if (::stat(path_.c_str(), &found) != 0 && errno == ENOENT) return std::optional<std::vector<std::byte>>();
  const Result<std::string> text = read_input_file(path_, kMost);
  if (!text) return text.error();
  if (!text->starts_with("orca " + kind_ + " "))
    return fail(Code::data_loss, "this file does not begin as one that keeps a " + kind_, path_);
  const std::size_t begin = text->find('\n') + 1;
  const auto bytes = std::as_bytes(std::span(std::string_view(*text).substr(begin)));
  if (begin == 0 || std::string_view(*text).substr(0, begin) != head_of(kind_, bytes))
    return fail(Code::data_loss, "this file is damaged: it does not hold what its first line says", path_);
  return std::optional(std::vector<std::byte>(bytes.begin(), bytes.end()));
}

Status KeptFile::write(std::span<const std::byte> bytes) const {
  const std::string draft = path_ + ".new";
  const std::string previous = path_ + ".old";
  Status written = contain_exhaustion([&] { return write_draft(draft, bytes); });
  // There is a file of the name at each instant.
  if (written.ok() && keeps_previous_) {
    ::unlink(previous.c_str());
    if (::link(path_.c_str(), previous.c_str()) != 0 && errno != ENOENT) written = system_error(previous);
  }
  if (written.ok() && ::rename(draft.c_str(), path_.c_str()) != 0) written = system_error(path_);
  if (!written.ok()) ::unlink(draft.c_str());
  return written;
}

// Nobody has opened the draft before: what a run that was killed has left is removed.
Status KeptFile::write_draft(const std::string& draft, std::span<const std::byte> bytes) const {
  constexpr mode_t kAsUsual = 0666;  // less the umask
  ::unlink(draft.c_str());
  const Descriptor file(
      ::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, kAsUsual));
  if (!file) return system_error(draft);
  const std::string head = head_of(kind_, bytes);
  if (Status begun = write_all(file.number(), std::as_bytes(std::span(head)), draft); !begun.ok())
    return begun;
  return write_all(file.number(), bytes, draft);
}

}  // namespace orca
