// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "orca/base/result.hpp"

namespace orca {

/// A file without a name that lives in memory, of a size that nobody can change any more. Other processes get it by
/// its descriptor; it is gone when the last of them has closed and unmapped it.
///
/// Thread contract: one thread at a time.
class MemoryFile {
 public:
  /// Who may write: all who have it, or only the process that maps it as its owner (SharedMemory::Use::owns).
  enum class Writers { all, owner };

  /// @param name  for people: it is shown in /proc/PID/maps, up to its 200th character.
  /// @param size  [bytes] > 0. The contents are zero and use memory only where they are written.
  /// @errors  unavailable if the system gives no more memory files or descriptors.
  [[nodiscard]] static Result<MemoryFile> create(const std::string& name, std::size_t size,
                                                 Writers writers = Writers::all);

  MemoryFile(MemoryFile&& other) noexcept;
  MemoryFile& operator=(MemoryFile&& other) noexcept;
  ~MemoryFile();

  /// Returns the descriptor, which is closed when a program is executed. It stays this object's.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  explicit MemoryFile(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;  // -1: none
};

/// The contents of a MemoryFile, mapped into this process. A copy of the process, made by fork(), has only those of an owner or reader.
///
/// Thread contract: as plain memory. Other processes may write it at any time.
class SharedMemory {
 public:
  /// The use that this process makes of the contents.
  enum class Use {
    shares,  ///< Reads and writes, as others do.
    owns,    ///< Reads and writes; from now on nobody else can map the file to be written.
    reads    ///< Only reads.
  };

  /// @param descriptor  of a memory file; the mapping does not need it afterwards.
  /// @errors  invalid_argument if it is no memory file, or one whose size can still change: a process that
  /// shrank it would end this one. unavailable if the system does not let it be owned.
  [[nodiscard]] static Result<SharedMemory> map(int descriptor, Use use = Use::shares);

  SharedMemory(SharedMemory&& other) noexcept;
  SharedMemory& operator=(SharedMemory&& other) noexcept;
  ~SharedMemory();

  /// Returns the contents. They begin on a page and stay where they are when the object is moved.
  [[nodiscard]] std::span<std::byte> bytes() const { return bytes_; }

 private:
  explicit SharedMemory(std::span<std::byte> bytes) : bytes_(bytes) {}

  std::span<std::byte> bytes_;
};

}  // namespace orca
