// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "orca/idl/bulk.hpp"
#include "orca/idl/reflection.hpp"

namespace orca::detail {

static_assert(std::endian::native == std::endian::little, "CDR is written as the machine holds it");

/// A number on the wire: aligned to its own size, little-endian.
template <class T>
concept WireNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// A writer of values in XCDR version 1, the encoding that Fast DDS uses, into memory of a fixed size. Alignment
/// counts from the first byte. Values that do not fit are counted, but not written.
///
/// Thread contract: one thread.
/// @source  OMG DDS-XTypes 1.3, 7.4.3 (plain CDR, version 1); CORBA 3.3 part 2, 9.3.
class CdrWriter {
 public:
  explicit CdrWriter(std::span<std::byte> to) : to_(to) {}
  /// Writes references in place of the bulk data that `lender` lends. Only a reader with its peer can read them.
  CdrWriter(std::span<std::byte> to, BulkLender& lender) : to_(to), lender_(&lender) {}

  /// Returns the number of bytes that the values take so far, whether they fitted or not.
  [[nodiscard]] std::size_t size() const { return used_; }

  template <class T>
  void field(const FieldInfo&, const T& value) {
    write(value);
  }

  template <WireNumber T>
  void write(T value) {
    write_numbers(std::span<const T>(&value, 1));
  }
  void write(bool value) { append_byte(static_cast<std::byte>(value)); }
  void write(const std::string& text) {
    const std::string_view visible(text.c_str());  // An IDL string contains no zero.
    write(static_cast<std::uint32_t>(visible.size() + 1));
    append(std::as_bytes(std::span(visible)));
    append_byte(std::byte{0});
  }
  template <ReflectedEnum T>
  void write(T value) {
    write(static_cast<std::uint32_t>(value));
  }
  template <ReflectedStruct T>
  void write(const T& value) {
    Reflection<T>::fields(value, *this);
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write(static_cast<std::uint32_t>(values.size()));
    write_elements(std::span<const T>(values));
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    write_elements(std::span<const T>(values));
  }
  template <class T>
  void write(const Bulk<T>& values) {
    if (lends(values.block(), values.size() * sizeof(T))) return;
    write(static_cast<std::uint32_t>(values.size()));
    write_elements(std::span<const T>(values));
  }

 private:
  bool lends(BulkBlock* block, std::size_t size) {
    if (lender_ == nullptr || block == nullptr || size < kLeastBulk) return false;
    const std::optional<BulkReference> reference = lender_->lend(*block);
    if (!reference) return false;
    write(kBulkMark);
    for (const std::uint64_t number : {reference->loan, reference->offset, std::uint64_t{size}})
      write(number);
    return true;
  }

  template <class T>
  void write_elements(std::span<const T> values) {
    if constexpr (WireNumber<T>) {
      if (!values.empty()) write_numbers(values);
    } else {
      for (const T& value : values) write(value);
    }
  }

  template <WireNumber T>
  void write_numbers(std::span<const T> numbers) {
    while (used_ % sizeof(T) != 0) append_byte(std::byte{0});
    append(std::as_bytes(numbers));
  }

  void append_byte(std::byte byte) {
    if (used_ < to_.size()) to_[used_] = byte;
    ++used_;
  }
  void append(std::span<const std::byte> bytes) {
    if (used_ <= to_.size() && bytes.size() <= to_.size() - used_ && !bytes.empty())
      std::memcpy(to_.data() + used_, bytes.data(), bytes.size());
    used_ += bytes.size();
  }

  std::span<std::byte> to_;
  BulkLender* lender_ = nullptr;
  std::size_t used_ = 0;
};

}  // namespace orca::detail
