// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/idl/bulk.hpp"
#include "orca/idl/cdr_writer.hpp"
#include "orca/idl/reflection.hpp"

namespace orca::detail {

/// Returns the fewest bytes that a value takes in XCDR1. It bounds the memory that a damaged length can make
/// the reader allocate.
template <class T>
constexpr std::size_t min_wire_size() {
  if constexpr (ReflectedStruct<T>) {
    return Reflection<T>::min_wire_size;
  } else if constexpr (WireNumber<T>) {
    return sizeof(T);
  } else {
    return sizeof(std::uint32_t);  // The length of a text, or an enumerator.
  }
}

/// A reader of the bytes that CdrWriter wrote. The bytes are not trusted: the first invalid value ends the
/// reading, and status() names its field.
///
/// Thread contract: one thread.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::byte> payload) : payload_(payload) {}
  /// Reads also references to bulk data that a peer has lent.
  CdrReader(std::span<const std::byte> payload, BulkSource& source) : payload_(payload), source_(&source) {}

  template <class T>
  void field(const FieldInfo& info, T& value) {
    if (failed()) return;
    read(value);
    if (failed()) note_field(info.name);
  }

  template <WireNumber T>
  void read(T& value) {
    read_numbers(std::span<T>(&value, 1));
  }
  void read(bool& value);
  void read(std::string& text);

  template <ReflectedEnum T>
  void read(T& value) {
    std::uint32_t number = 0;
    read(number);
    if (failed()) return;
    if (number >= EnumReflection<T>::names.size()) {
      fail_enumerator(EnumReflection<T>::name, number, EnumReflection<T>::names.size());
      return;
    }
    value = static_cast<T>(number);
  }
  template <ReflectedStruct T>
  void read(T& value) {
    Reflection<T>::fields(value, *this);
  }
  template <class T>
  void read(std::vector<T>& values) {
    const std::size_t count = read_count(min_wire_size<T>());
    if (failed()) return;
    if constexpr (WireNumber<T>) {
      if (assign_in_place(values, count)) return;
    }
    values.resize(count);
    read_elements(std::span<T>(values));
  }
  template <class T>
  void read(Bulk<T>& values) {
    if (BulkReference reference; read_reference(reference)) {
      if (BulkBlock* const block = borrow(reference, sizeof(T)))
        values.show(*block, reference.size / sizeof(T));
      return;
    }
    const std::size_t count = read_count(sizeof(T));
    if (failed()) return;
    values.clear();
    values.resize_for_overwrite(count);
    read_elements(std::span<T>(values));
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& values) {
    read_elements(std::span<T>(values));
  }

  /// Returns the result of the reading. Call after all fields.
  [[nodiscard]] Status status(std::string_view type_name) const;

 private:
  template <class T>
  void read_elements(std::span<T> values) {
    if constexpr (WireNumber<T>) {
      if (!values.empty()) read_numbers(values);
    } else {
      for (T& value : values) {
        read(value);
        if (failed()) return;
      }
    }
  }

  // Copies a sequence from where it stands, if it stands aligned. The memory is then not cleared before.
  template <WireNumber T>
  bool assign_in_place(std::vector<T>& values, std::size_t count) {
    const std::size_t start = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    if (start > payload_.size() || count > (payload_.size() - start) / sizeof(T)) return false;
    const std::byte* const from = payload_.data() + start;
    if (count == 0 || reinterpret_cast<std::uintptr_t>(from) % alignof(T) != 0) return false;
    const auto* const first = reinterpret_cast<const T*>(from);
    values.assign(first, first + count);
    at_ = start + count * sizeof(T);
    return true;
  }

  template <WireNumber T>
  void read_numbers(std::span<T> numbers) {
    at_ = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    copy_out(std::as_writable_bytes(numbers));
  }

  [[nodiscard]] bool failed() const { return !problem_.empty(); }
  [[nodiscard]] std::size_t remaining() const { return at_ < payload_.size() ? payload_.size() - at_ : 0; }
  /// Reads the length of a sequence; fails if the payload cannot hold as many elements.
  std::size_t read_count(std::size_t element_size);
  void copy_out(std::span<std::byte> to);
  /// Reads a reference if one stands here; nothing is read otherwise.
  bool read_reference(BulkReference& reference);
  /// Returns the block of a reference; null, and it fails, if there is none or it holds no whole elements.
  BulkBlock* borrow(const BulkReference& reference, std::size_t element_size);
  void note_field(std::string_view name);
  void fail_enumerator(std::string_view name, std::uint32_t found, std::size_t count);

  std::span<const std::byte> payload_;
  BulkSource* source_ = nullptr;
  std::size_t at_ = 0;
  std::string problem_;
  std::string path_;
};

}  // namespace orca::detail
