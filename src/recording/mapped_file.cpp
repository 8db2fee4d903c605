// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "orca/base/descriptor.hpp"

namespace orca::recording {

Result<MappedFile> MappedFile::open(const std::string& path) {
  const auto refuse = [&](int reason) {
    return fail(Code::invalid_argument, std::string("cannot read the file: ") + std::strerror(reason), path);
  };
  // Without O_NONBLOCK, a pipe that nobody writes to would block here for ever.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (file.number() < 0) return refuse(errno);
  struct stat status {};
  if (fstat(file.number(), &status) != 0) return refuse(errno);
  if (!S_ISREG(status.st_mode)) return fail(Code::invalid_argument, "this is no regular file", path);
  MappedFile mapped;
  if (status.st_size == 0) return mapped;
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const place = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0);
  if (place == MAP_FAILED) return refuse(errno);
  mapped.bytes_ = {static_cast<const std::byte*>(place), size};
  return mapped;
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace orca::recording
