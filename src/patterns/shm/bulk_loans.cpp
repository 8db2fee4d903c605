// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bulk_loans.hpp"

#include <string>
#include <utility>

#include "ring.hpp"

namespace orca::shm {
namespace {

constexpr std::size_t kAlignment = 64;  // [bytes] of what is borrowed, so that it can hold any numbers
static_assert(2 * (sizeof(RingControl) + sizeof(LoanControl)) <= kControlSize);
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

// A block in the pool of another process.
struct Borrowed : detail::BulkBlock {
  std::shared_ptr<const SharedMemory> pool;
  std::shared_ptr<const SharedMemory> segment;  // that holds `returned`
  std::atomic<std::uint64_t>* returned;
  std::uint64_t loan;
  unsigned copies;  // of the process when it was borrowed
};

// A copy of the process gives nothing back. The segment is not mapped there, so it must not be unmapped either.
void give_back(detail::BulkBlock& block) noexcept {
  auto* const borrowed = static_cast<Borrowed*>(&block);
  if (borrowed->copies != detail::copies_of_process()) return;
  borrowed->returned->store(borrowed->loan, std::memory_order_release);
  delete borrowed;
}

}  // namespace

LoanControl& loans_in(std::span<std::byte> segment, std::size_t index) {
  std::byte* const behind = segment.data() + 2 * sizeof(RingControl);
  return *(reinterpret_cast<LoanControl*>(behind) + index);
}

std::shared_ptr<Loans> Loans::make() {
  const std::shared_ptr<Loans> loans(new Loans);
  BulkPool::own().add(loans);
  return loans;
}

void Loans::restart(std::shared_ptr<const SharedMemory> memory, LoanControl& control) {
  const MutexLock lock(mutex_);
  memory_ = std::move(memory);
  control_ = &control;
  control.pool.store(BulkPool::own().identity(), std::memory_order_release);
}

void Loans::leave() {
  const MutexLock lock(mutex_);
  memory_ = nullptr;
  control_ = nullptr;
}

void Loans::take_back() {
  const MutexLock lock(mutex_);
  for (Loan& loan : loans_) end(loan);
}

std::optional<detail::BulkReference> Loans::lend(detail::BulkBlock& block) {
  const MutexLock lock(mutex_);
  const std::uint64_t own = BulkPool::own().identity();
  if (block.ended != nullptr || own == 0 || control_ == nullptr ||
      control_->readable.load(std::memory_order_acquire) != own)
    return std::nullopt;
  // The same object is written again where it found no room at first.
  for (const Loan& loan : loans_)
    if (loan.is_new && loan.block == &block) return reference(loan);
  collect_returned();
  if (lent_ + block.size > kMostLent) return std::nullopt;
  for (std::size_t place = 0; place < kMostLoans; ++place) {
    Loan& loan = loans_[place];
    if (loan.block != nullptr) continue;
    block.references.fetch_add(1, std::memory_order_relaxed);
    lent_ += block.size;
    has_new_ = true;
    loan = {&block, ++count_ * kMostLoans + place, true, memory_, &control_->returned[place]};
    return reference(loan);
  }
  return std::nullopt;
}

void Loans::settle(bool is_sent) {
  if (!has_new_.load(std::memory_order_relaxed)) return;  // as after every small object
  const MutexLock lock(mutex_);
  has_new_ = false;
  for (Loan& loan : loans_) {
    if (!std::exchange(loan.is_new, false)) continue;
    if (!is_sent) end(loan);
  }
}

bool Loans::collect() noexcept {
  const MutexLock lock(mutex_);
  collect_returned();
  return control_ != nullptr || lent_ > 0;
}

void Loans::collect_returned() {
  for (Loan& loan : loans_) {
    if (loan.block == nullptr || loan.is_new) continue;
    if (loan.returned->load(std::memory_order_acquire) == loan.number) end(loan);
  }
}

void Loans::end(Loan& loan) {
  if (loan.block == nullptr) return;
  lent_ -= loan.block->size;
  release(*std::exchange(loan.block, nullptr));
  loan.memory = nullptr;
}

detail::BulkReference Loans::reference(const Loan& loan) { return {loan.number, loan.block->offset, 0}; }

void Borrowing::restart(std::shared_ptr<const SharedMemory> memory, LoanControl& control) {
  memory_ = std::move(memory);
  control_ = &control;
  pool_ = nullptr;
}

void Borrowing::look() {
  if (pool_ != nullptr) return;
  const std::uint64_t identity = control_->pool.load(std::memory_order_acquire);
  if (identity == 0) return;
  pool_ = PeerPools::all().find(identity);
  if (pool_ != nullptr) control_->readable.store(identity, std::memory_order_release);
}

Result<detail::BulkBlock*> Borrowing::borrow(const detail::BulkReference& reference) {
  look();
  if (pool_ == nullptr) return fail(Code::data_loss, "a reference to a pool that this process cannot read");
  const std::span<std::byte> bytes = pool_->bytes();
  const auto [loan, offset, size] = reference;
  if (offset > bytes.size() || size > bytes.size() - offset || offset % kAlignment != 0)
    return fail(Code::data_loss, "a reference to " + std::to_string(size) + " bytes at " +
                                     std::to_string(offset) + " of a pool of " +
                                     std::to_string(bytes.size()));
  auto borrowed = std::make_unique<Borrowed>();
  borrowed->data = bytes.data() + offset;
  borrowed->size = size;
  borrowed->offset = offset;
  borrowed->ended = give_back;
  borrowed->pool = pool_;
  borrowed->segment = memory_;
  borrowed->returned = &control_->returned[loan % kMostLoans];
  borrowed->loan = loan;
  borrowed->copies = detail::copies_of_process();
  return borrowed.release();
}

}  // namespace orca::shm
