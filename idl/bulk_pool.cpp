// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/bulk_pool.hpp"

#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

namespace orca {
namespace {

constexpr std::size_t kPage = 4096;  // [bytes]

std::atomic<unsigned> g_copies{0};
std::atomic<std::byte*> g_own{
    nullptr};  // the beginning of the own pool, which a copy of the process must not write

void note_copy() {
  g_copies.fetch_add(1, std::memory_order_relaxed);
  if (std::byte* const own = g_own.exchange(nullptr, std::memory_order_relaxed))
    mprotect(own, kBulkPoolSize, PROT_READ);
}

[[maybe_unused]] const int g_registered = pthread_atfork(nullptr, nullptr, note_copy);

// Returns the number of a memory file, which no other one has as long as it exists.
Result<std::uint64_t> identity_of(const Descriptor& file) {
  struct stat status {};
  if (fstat(file.number(), &status) != 0 || status.st_size != static_cast<off_t>(kBulkPoolSize))
    return fail(Code::invalid_argument, "a descriptor is no pool of bulk data");
  return static_cast<std::uint64_t>(status.st_ino);
}

}  // namespace

namespace detail {

unsigned copies_of_process() noexcept { return g_copies.load(std::memory_order_relaxed); }

void release(BulkBlock& block) noexcept {
  void (*const ended)(BulkBlock&) noexcept = block.ended;  // an own block may be taken again at once
  if (block.references.fetch_sub(1, std::memory_order_acq_rel) == 1 && ended != nullptr) ended(block);
}

void give_back(BulkMemory& memory) noexcept {
  if (memory.block != nullptr)
    release(*memory.block);
  else
    ::operator delete(memory.data);
  memory = {};
}

namespace {

// Returns whether the memory is this list's alone.
bool is_writable(const BulkMemory& memory) {
  const BulkBlock* const block = memory.block;
  return block == nullptr ||
         (block->ended == nullptr && block->references.load(std::memory_order_acquire) == 1);
}

// Returns a piece of the own pool; without a block if it has none.
BulkMemory take_piece(std::size_t size) {
  BulkBlock* const block = size >= kLeastBulk ? BulkPool::own().take(size) : nullptr;
  return block != nullptr ? BulkMemory{block->data, block->size, block} : BulkMemory{};
}

}  // namespace

void reserve_bulk(BulkMemory& memory, std::size_t used, std::size_t wanted) {
  const bool suffices = is_writable(memory) && wanted <= memory.capacity;
  const bool may_move = used == 0 && memory.block == nullptr && wanted >= kLeastBulk;
  if (suffices && !may_move) return;
  // A list that grows by and by does not move each time.
  const std::size_t size = used == 0 ? wanted : std::max(wanted, memory.capacity + memory.capacity / 2);
  BulkMemory other = take_piece(size);
  if (other.block == nullptr && suffices) return;
  if (other.block == nullptr) other = {static_cast<std::byte*>(::operator new(size)), size, nullptr};
  if (used > 0) std::memcpy(other.data, memory.data, used);
  give_back(memory);
  memory = other;
}

}  // namespace detail

BulkPool& BulkPool::own() {
  static BulkPool* const pool = new BulkPool;  // objects may be dropped while the program ends
  return *pool;
}

std::uint64_t BulkPool::identity() const {
  const std::uint64_t identity = identity_.load(std::memory_order_acquire);
  return identity != 0 && copies_ == detail::copies_of_process() ? identity : 0;
}

Status BulkPool::provide(Descriptor file) {
  const Result<std::uint64_t> identity = identity_of(file);
  if (!identity) return identity.error();
  const MutexLock lock(mutex_);
  leave_to_original();
  if (identity_ != 0) return fail(Code::already_exists, "the process has a pool of bulk data");
  file_ = std::move(file);
  identity_.store(*identity, std::memory_order_release);
  return ok();
}

// In a copy of the process, forgets the pool of the original. Its pieces are still shown, and the memory of its lenders is not
// mapped here, so none of them is destroyed.
void BulkPool::leave_to_original() {
  if (copies_.exchange(detail::copies_of_process()) == detail::copies_of_process()) return;
  struct Left {
    decltype(blocks_) blocks;
    decltype(memory_) memory;
    decltype(lenders_) lenders;
  };
  [[maybe_unused]] static const Left* left = nullptr;  // so that a leak checker finds it
  left =
      new Left{std::exchange(blocks_, {}), std::exchange(memory_, std::nullopt), std::exchange(lenders_, {})};
  identity_ = 0;
  file_.reset();
}

// Maps the memory when it is first needed. Afterwards nobody else can map it to be written.
bool BulkPool::map() {
  if (memory_) return true;
  if (!file_) return false;
  const Descriptor file = std::exchange(file_, {});
  Result<SharedMemory> mapped = SharedMemory::map(file.number(), SharedMemory::Use::owns);
  if (!mapped) return false;
  memory_.emplace(std::move(mapped).value());
  g_own = memory_->bytes().data();
  return true;
}

detail::BulkBlock* BulkPool::take(std::size_t bytes) noexcept {
  if (bytes > kBulkPoolSize || identity() == 0) return nullptr;
  const std::size_t size = (bytes + kPage - 1) / kPage * kPage;
  const MutexLock lock(mutex_);
  if (!map()) return nullptr;
  collect();
  std::size_t offset = 0;
  const auto before = gap(size, offset);
  return before ? insert(*before, offset, size) : nullptr;
}

std::size_t BulkPool::used() {
  const MutexLock lock(mutex_);
  leave_to_original();
  collect();
  std::size_t sum = 0;
  for (const auto& block : blocks_) sum += block->size;
  return sum;
}

// Forgets the pieces to which nobody refers any more.
void BulkPool::collect() {
  std::erase_if(lenders_, [](const auto& lender) { return !lender->collect(); });
  const auto is_free = [](const auto& block) {
    return block->references.load(std::memory_order_acquire) == 0;
  };
  const auto rest =
      std::stable_partition(blocks_.begin(), blocks_.end(), [&](const auto& b) { return !is_free(b); });
  std::move(rest, blocks_.end(), std::back_inserter(spare_));
  blocks_.erase(rest, blocks_.end());
}

// Finds the first gap of that size, so that the memory which is in use stays small.
std::optional<BulkPool::Blocks::iterator> BulkPool::gap(std::size_t bytes, std::size_t& offset) {
  offset = 0;
  for (auto at = blocks_.begin(); at != blocks_.end(); ++at) {
    if ((*at)->offset - offset >= bytes) return at;
    offset = (*at)->offset + (*at)->size;
  }
  if (kBulkPoolSize - offset < bytes) return std::nullopt;
  return blocks_.end();
}

detail::BulkBlock* BulkPool::insert(Blocks::iterator before, std::size_t offset, std::size_t bytes) {
  auto record = spare_.empty() ? std::make_unique<detail::BulkBlock>() : std::move(spare_.back());
  if (!spare_.empty()) spare_.pop_back();
  record->data = memory_->bytes().data() + offset;
  record->size = bytes;
  record->offset = offset;
  record->ended = nullptr;
  record->references.store(1, std::memory_order_relaxed);
  return blocks_.insert(before, std::move(record))->get();
}

void BulkPool::add(std::shared_ptr<Lender> lender) {
  const MutexLock lock(mutex_);
  leave_to_original();
  collect();  // forgets those that have gone
  lenders_.push_back(std::move(lender));
}

PeerPools& PeerPools::all() {
  static PeerPools* const pools = new PeerPools;
  return *pools;
}

Status PeerPools::note(const std::string& process, Descriptor file) {
  const Result<std::uint64_t> identity = identity_of(file);
  if (!identity) return identity.error();
  const MutexLock lock(mutex_);
  Peer& peer = peers_[process];
  if (peer.identity != *identity) peer = {*identity, std::move(file), nullptr};
  return ok();
}

std::shared_ptr<const SharedMemory> PeerPools::find(std::uint64_t identity) {
  const MutexLock lock(mutex_);
  for (auto& [process, peer] : peers_) {
    if (peer.identity != identity) continue;
    if (peer.memory == nullptr) {
      Result<SharedMemory> mapped = SharedMemory::map(peer.file.number(), SharedMemory::Use::reads);
      if (!mapped) return nullptr;
      peer.memory = std::make_shared<const SharedMemory>(std::move(mapped).value());
      peer.file.reset();
    }
    return peer.memory;
  }
  return nullptr;
}

}  // namespace orca
