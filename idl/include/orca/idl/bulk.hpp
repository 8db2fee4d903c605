// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"

namespace orca {

namespace detail {

/// A piece of a pool of shared memory. Bulk refers to it, and so does whoever has lent it to another process.
struct BulkBlock {
  std::byte* data;
  std::size_t size;      ///< [bytes]
  std::uint64_t offset;  ///< In its pool [bytes].
  /// Called when nobody refers to it any more; null: it is in this process's own pool, which looks for such blocks.
  void (*ended)(BulkBlock& block) noexcept;
  std::atomic<std::uint32_t> references{1};
};

void release(BulkBlock& block) noexcept;

/// The memory of a Bulk: on the heap, or a block.
struct BulkMemory {
  std::byte* data = nullptr;
  std::size_t capacity = 0;    ///< [bytes]
  BulkBlock* block = nullptr;  ///< Null: on the heap.
};

/// Makes room for `wanted` bytes that may be written, and keeps the first `used`. A large list goes to the own pool, if
/// there is one and it has room.
void reserve_bulk(BulkMemory& memory, std::size_t used, std::size_t wanted);
void give_back(BulkMemory& memory) noexcept;

/// The least that goes to a pool [bytes]. Less is copied faster than it is lent.
inline constexpr std::size_t kLeastBulk = std::size_t{16} << 10;

/// A place in a pool, as one process gives it to another.
struct BulkReference {
  std::uint64_t loan = 0;    ///< Number of the loan on its edge.
  std::uint64_t offset = 0;  ///< In the pool [bytes].
  std::uint64_t size = 0;    ///< [bytes]
};

/// Stands in bytes for the number of elements where a reference follows. No sequence is that long.
inline constexpr std::uint32_t kBulkMark = 0xFFFFFFFF;

/// Lends blocks of the own pool to another process, while an object is written.
class BulkLender {
 public:
  /// Returns the reference that the other process gets; its size is not set. Nothing: it has to get a copy.
  virtual std::optional<BulkReference> lend(BulkBlock& block) = 0;

 protected:
  ~BulkLender() = default;
};

/// Finds what another process has lent, while an object is read.
class BulkSource {
 public:
  /// Returns a block that may only be read, with one reference that is the caller's.
  /// @errors  data_loss if there is no such place.
  virtual Result<BulkBlock*> borrow(const BulkReference& reference) = 0;

 protected:
  ~BulkSource() = default;
};

}  // namespace detail

/// A type of the elements of bulk data: an octet or a number.
template <class T>
concept BulkElement = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// A list of many octets or numbers, such as an image: a field that the IDL marks with `@bulk`. It is used like a
/// std::vector. From 16 KB on it lies in memory that other processes of this machine can read, if this process has any (ADR
/// 0104), so an object that is pushed there takes its bulk data along without a copy.
///
/// An object that came from another process may show that process's memory. It is immutable like all received objects, and
/// a copy of it is memory of this process.
///
/// Thread contract: as std::vector.
template <BulkElement T>
class Bulk {
 public:
  using value_type = T;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using reference = T&;
  using const_reference = const T&;
  using iterator = T*;
  using const_iterator = const T*;

  Bulk() = default;
  explicit Bulk(std::size_t count) { resize(count); }
  Bulk(std::initializer_list<T> values) { assign(values.begin(), values.end()); }
  Bulk(std::span<const T> values) {
    assign(values.begin(), values.end());
  }  // NOLINT(google-explicit-constructor)
  Bulk(const std::vector<T>& values) {
    assign(values.begin(), values.end());
  }  // NOLINT(google-explicit-constructor)
  Bulk(const Bulk& other) { assign(other.begin(), other.end()); }
  Bulk(Bulk&& other) noexcept
      : memory_(std::exchange(other.memory_, {})), size_(std::exchange(other.size_, 0)) {}
  Bulk& operator=(const Bulk& other) {
    if (this != &other) assign(other.begin(), other.end());
    return *this;
  }
  Bulk& operator=(Bulk&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~Bulk() { detail::give_back(memory_); }

  operator std::vector<T>() const { return {begin(), end()}; }  // NOLINT(google-explicit-constructor)

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return memory_.capacity / sizeof(T); }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* data() { return reinterpret_cast<T*>(memory_.data); }
  [[nodiscard]] const T* data() const { return reinterpret_cast<const T*>(memory_.data); }
  [[nodiscard]] T* begin() { return data(); }
  [[nodiscard]] T* end() { return data() + size_; }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size_; }
  /// @pre  index < size(), and not empty for front() and back().
  T& operator[](std::size_t index) { return data()[index]; }
  const T& operator[](std::size_t index) const { return data()[index]; }
  [[nodiscard]] T& front() { return *data(); }
  [[nodiscard]] const T& front() const { return *data(); }
  [[nodiscard]] T& back() { return data()[size_ - 1]; }
  [[nodiscard]] const T& back() const { return data()[size_ - 1]; }
  /// Throws std::out_of_range, as std::vector does.
  [[nodiscard]] T& at(std::size_t index) { return data()[checked(index)]; }
  [[nodiscard]] const T& at(std::size_t index) const { return data()[checked(index)]; }

  void reserve(std::size_t count) { make_room(count); }
  /// New elements are 0.
  void resize(std::size_t count) {
    const std::size_t before = size_;
    resize_for_overwrite(count);
    if (count > before) std::memset(data() + before, 0, (count - before) * sizeof(T));
  }
  /// The contents of new elements are not specified: for whoever writes them all.
  void resize_for_overwrite(std::size_t count) {
    make_room(count);
    size_ = count;
  }
  /// Memory on the heap stays for what comes next; a place in a pool goes back.
  void clear() {
    let_go();
    size_ = 0;
  }
  void push_back(T value) {
    resize_for_overwrite(size_ + 1);
    back() = value;
  }
  void assign(std::size_t count, T value) {
    clear();
    resize_for_overwrite(count);
    std::fill(begin(), end(), value);
  }
  /// @pre  the elements are not this list's own.
  template <std::forward_iterator Iterator>
  void assign(Iterator first, Iterator last) {
    clear();
    resize_for_overwrite(static_cast<std::size_t>(std::distance(first, last)));
    std::copy(first, last, begin());
  }
  void assign(std::initializer_list<T> values) { assign(values.begin(), values.end()); }

  friend bool operator==(const Bulk& a, const Bulk& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

  // For the framework.

  /// Returns the block that holds the elements; null if they are on the heap.
  [[nodiscard]] detail::BulkBlock* block() const { return memory_.block; }
  /// Shows the first elements of a block instead, and takes over the caller's reference to it.
  /// @pre  the block holds so many.
  void show(detail::BulkBlock& block, std::size_t count) {
    detail::give_back(memory_);
    memory_ = {block.data, block.size, &block};
    size_ = count;
  }
  /// Becomes empty if the elements are in a block, which goes back.
  void let_go() noexcept {
    if (memory_.block == nullptr) return;
    detail::give_back(memory_);
    size_ = 0;
  }

 private:
  // A large list is kept on the heap only as long as there are elements, in case that there is room in a pool again.
  void make_room(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    const bool stays = memory_.block == nullptr && (size_ > 0 || bytes < detail::kLeastBulk);
    if (bytes > memory_.capacity || !stays) detail::reserve_bulk(memory_, size_ * sizeof(T), bytes);
  }
  [[nodiscard]] std::size_t checked(std::size_t index) const {
    if (index >= size_) throw std::out_of_range("Bulk::at");
    return index;
  }

  detail::BulkMemory memory_;
  std::size_t size_ = 0;
};

}  // namespace orca
