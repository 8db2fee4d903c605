// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/base/shared_memory.hpp"
#include "orca/idl/bulk.hpp"

namespace orca {

/// The size of a process's pool for bulk data [bytes]. Memory is used only where it was written once.
inline constexpr std::size_t kBulkPoolSize = std::size_t{64} << 20;

/// The bulk data of this process that other processes can read: a memory file of a fixed size, in pieces of whole pages. A piece is
/// free again when neither an object here nor a process that has borrowed it refers to it. A copy of the process, made by fork(), can
/// read its pieces and takes none.
///
/// Thread contract: any thread.
class BulkPool {
 public:
  /// Whoever has lent pieces to another process.
  class Lender {
   public:
    /// Releases what has come back.
    /// @return whether anything may still come back; otherwise it is forgotten.
    virtual bool collect() noexcept = 0;

   protected:
    ~Lender() = default;  // by its own type
  };

  /// Returns the pool of this process. It has no memory until provide(), and is never destroyed.
  static BulkPool& own();

  /// Gives the pool its memory, once in the life of a process. A copy of the process may get memory of its own.
  /// @param file  may be sealed against writing; it is mapped when it is first needed.
  /// @errors  already_exists; invalid_argument if it is no memory file.
  Status provide(Descriptor file);

  /// Returns the number of the memory file, by which others know it; 0: there is none.
  [[nodiscard]] std::uint64_t identity() const;
  /// Returns a piece with one reference; null if there is no room.
  [[nodiscard]] detail::BulkBlock* take(std::size_t bytes) noexcept;
  /// Returns how much is taken now [bytes].
  [[nodiscard]] std::size_t used();

  void add(std::shared_ptr<Lender> lender);

 private:
  using Blocks = std::vector<std::unique_ptr<detail::BulkBlock>>;

  BulkPool() = default;
  void leave_to_original() ORCA_REQUIRES(mutex_);
  bool map() ORCA_REQUIRES(mutex_);
  void collect() ORCA_REQUIRES(mutex_);
  std::optional<Blocks::iterator> gap(std::size_t bytes, std::size_t& offset) ORCA_REQUIRES(mutex_);
  detail::BulkBlock* insert(Blocks::iterator before, std::size_t offset, std::size_t bytes)
      ORCA_REQUIRES(mutex_);

  std::atomic<std::uint64_t> identity_{0};
  std::atomic<unsigned> copies_{0};  // of the process whose pool this is
  Mutex mutex_;
  Descriptor file_ ORCA_GUARDED_BY(mutex_);  // until it is mapped
  std::optional<SharedMemory> memory_ ORCA_GUARDED_BY(mutex_);
  Blocks blocks_ ORCA_GUARDED_BY(mutex_);  // that are taken, in their order
  Blocks spare_ ORCA_GUARDED_BY(mutex_);   // records without a piece
  std::vector<std::shared_ptr<Lender>> lenders_ ORCA_GUARDED_BY(mutex_);
};

/// The pools of the other processes of this machine, as far as this one knows them.
///
/// Thread contract: any thread.
class PeerPools {
 public:
  static PeerPools& all();

  /// Notes the pool of a process; a former one of this name is forgotten, and stays mapped while an object shows it.
  /// @errors  invalid_argument if it is no memory file.
  Status note(const std::string& process, Descriptor file);
  /// Returns the contents of a pool by its identity, to be read only; null if it is not known.
  [[nodiscard]] std::shared_ptr<const SharedMemory> find(std::uint64_t identity);

 private:
  struct Peer {
    std::uint64_t identity = 0;
    Descriptor file;  // until it is mapped
    std::shared_ptr<const SharedMemory> memory;
  };

  PeerPools() = default;

  Mutex mutex_;
  std::map<std::string, Peer> peers_ ORCA_GUARDED_BY(mutex_);
};

namespace detail {

/// Returns how many copies of copies this process is, by fork(): what belongs to the original is not touched in a copy.
[[nodiscard]] unsigned copies_of_process() noexcept;

}  // namespace detail
}  // namespace orca
