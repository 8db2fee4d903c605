// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace orca {
namespace {

constexpr int kFixedSize = F_SEAL_SHRINK | F_SEAL_GROW;
constexpr std::size_t kLongestName = 200;

Error system_error(Code code, const std::string& what) {
  return fail(code, what + ": " + std::generic_category().message(errno));
}

// Gives a new file its size, for ever.
bool fix_size(int descriptor, std::size_t size, MemoryFile::Writers writers) {
  const int seals = writers == MemoryFile::Writers::all ? kFixedSize | F_SEAL_SEAL : kFixedSize;
  return ftruncate(descriptor, static_cast<off_t>(size)) == 0 && fcntl(descriptor, F_ADD_SEALS, seals) == 0;
}

}  // namespace

Result<MemoryFile> MemoryFile::create(const std::string& name, std::size_t size, Writers writers) {
  MemoryFile file(memfd_create(name.substr(0, kLongestName).c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (file.descriptor_ < 0 || !fix_size(file.descriptor_, size, writers))
    return system_error(Code::unavailable,
                        "no memory file of " + std::to_string(size) + " bytes for " + name);
  return file;
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

MemoryFile& MemoryFile::operator=(MemoryFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

MemoryFile::~MemoryFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

Result<SharedMemory> SharedMemory::map(int descriptor, Use use) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0)
    return system_error(Code::invalid_argument, "descriptor " + std::to_string(descriptor));
  const int seals = fcntl(descriptor, F_GET_SEALS);
  if (seals < 0 || (seals & kFixedSize) != kFixedSize || status.st_size <= 0)
    return fail(Code::invalid_argument,
                "descriptor " + std::to_string(descriptor) + " is no memory file of a fixed size");
  const auto size = static_cast<std::size_t>(status.st_size);
  const int access = use == Use::reads ? PROT_READ : PROT_READ | PROT_WRITE;
  void* const place = mmap(nullptr, size, access, MAP_SHARED, descriptor, 0);
  if (place == MAP_FAILED)
    return system_error(Code::unavailable, "cannot map " + std::to_string(size) + " bytes of shared memory");
  SharedMemory memory({static_cast<std::byte*>(place), size});
  if (use == Use::owns && fcntl(descriptor, F_ADD_SEALS, F_SEAL_FUTURE_WRITE | F_SEAL_SEAL) != 0)
    return system_error(Code::unavailable, "cannot keep others from writing shared memory");
  if (use == Use::shares)
    madvise(place, size,
            MADV_DONTFORK);  // what a copy of the process tries out must not reach other processes
  return memory;
}

SharedMemory::SharedMemory(SharedMemory&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

SharedMemory& SharedMemory::operator=(SharedMemory&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

SharedMemory::~SharedMemory() {
  if (!bytes_.empty()) munmap(bytes_.data(), bytes_.size());
}

}  // namespace orca
