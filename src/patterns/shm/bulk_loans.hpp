// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// How the two ends of an edge lend bulk data to each other. The writer of a ring says which pool is its own, and the reader
/// that it can read that pool; from then on the writer puts references into the ring. Each loan has a number, which the
/// reader writes into the loan's word when it shows the data to nobody any more. The writer looks at the words when it needs memory:
/// nobody is woken. Nothing that stands in shared memory is trusted.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "orca/base/mutex.hpp"
#include "orca/base/shared_memory.hpp"
#include "orca/idl/bulk_pool.hpp"

namespace orca::shm {

/// The most loans of one ring that are not given back yet, and the most bytes of the pool that they may hold. More
/// is copied, so a reader that keeps what it gets, or hangs, costs the other readers nothing.
inline constexpr std::size_t kMostLoans = 32;
inline constexpr std::size_t kMostLent = kBulkPoolSize / 4;

/// The state of the loans of a ring, as it stands in shared memory; all zero at first.
struct LoanControl {
  alignas(64) std::atomic<std::uint64_t> pool;  ///< The writer's: identity of its pool; 0: it has none.
  // The reader's.
  alignas(64) std::atomic<std::uint64_t> readable;  ///< Identity of the pool that it can read.
  std::array<std::atomic<std::uint64_t>, kMostLoans>
      returned;  ///< Number of the loan that came back last, per place.
};

/// Returns that of one of the two rings in the memory of a segment. It stands behind the states of the rings.
[[nodiscard]] LoanControl& loans_in(std::span<std::byte> segment, std::size_t index);

/// The writer's side.
///
/// Thread contract: any thread; an object is written in one piece, from its first lend() to settle().
class Loans final : public detail::BulkLender, public BulkPool::Lender {
 public:
  /// Makes one, which the own pool knows. It has no segment yet.
  static std::shared_ptr<Loans> make();

  /// Goes on in a fresh segment.
  /// @param memory  of the segment, which holds `control`.
  void restart(std::shared_ptr<const SharedMemory> memory, LoanControl& control);
  /// Lends nothing more. A reader keeps its loans until it gives them back.
  void leave();
  /// Takes back all that was lent: the reader has ended.
  void take_back();

  std::optional<detail::BulkReference> lend(detail::BulkBlock& block) override;
  /// Says whether what was lent since the last call is on its way to the reader. If not, it comes back.
  void settle(bool is_sent);
  bool collect() noexcept override;

 private:
  struct Loan {
    detail::BulkBlock* block = nullptr;  // null: this place is free
    std::uint64_t number = 0;
    bool is_new = false;                                   // not settled yet
    std::shared_ptr<const SharedMemory> memory = nullptr;  // of the segment that has its word
    std::atomic<std::uint64_t>* returned = nullptr;
  };

  Loans() = default;
  void collect_returned() ORCA_REQUIRES(mutex_);
  void end(Loan& loan) ORCA_REQUIRES(mutex_);
  [[nodiscard]] static detail::BulkReference reference(const Loan& loan);

  Mutex mutex_;
  std::shared_ptr<const SharedMemory> memory_ ORCA_GUARDED_BY(mutex_);
  LoanControl* control_ ORCA_GUARDED_BY(mutex_) = nullptr;  // null: it lends nothing
  std::array<Loan, kMostLoans> loans_ ORCA_GUARDED_BY(mutex_);
  std::size_t lent_ ORCA_GUARDED_BY(mutex_) = 0;     // [bytes]
  std::uint64_t count_ ORCA_GUARDED_BY(mutex_) = 0;  // of all loans
  std::atomic<bool> has_new_{false};                 // a loan that is not settled yet
};

/// The reader's side.
///
/// Thread contract: one thread at a time. Borrowed blocks may be dropped in any thread, and outlive this.
class Borrowing final : public detail::BulkSource {
 public:
  Borrowing(std::shared_ptr<const SharedMemory> memory, LoanControl& control)
      : memory_(std::move(memory)), control_(&control) {}
  /// Goes on in a fresh segment.
  void restart(std::shared_ptr<const SharedMemory> memory, LoanControl& control);

  Result<detail::BulkBlock*> borrow(const detail::BulkReference& reference) override;
  /// Looks, when a large frame comes, whether this process can read the writer's pool, and lets the writer know.
  void look();

 private:
  std::shared_ptr<const SharedMemory> memory_;  // of the segment
  LoanControl* control_;
  std::shared_ptr<const SharedMemory> pool_;  // null: not known yet
};

}  // namespace orca::shm
