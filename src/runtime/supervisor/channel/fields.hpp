// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/supervisor/message.hpp"

namespace orca::supervisor {

/// FieldWriter and FieldReader have the same functions, so that one list of fields serves both directions. A number has 8
/// bytes, little-endian. A text and a row of bytes have their length, as a number, and then the bytes.

/// Writes fields to the end of a message.
class FieldWriter {
 public:
  /// @param message  must outlive the writer.
  explicit FieldWriter(Message& message) : message_(message) {}

  void number(std::uint64_t& value);
  void text(std::string& text);
  void bytes(std::vector<std::byte>& bytes);
  /// Moves the descriptor into the message.
  void descriptor(Descriptor& descriptor);
  /// Does nothing: see FieldReader.
  template <class T>
  void resize(std::vector<T>& /*list*/, std::uint64_t /*count*/) {}
  void require(bool /*condition*/) {}

 private:
  void append(std::span<const std::byte> bytes);

  Message& message_;
};

/// Reads the fields of a message from an untrusted sender. After the first fault every field reads as zero or empty.
class FieldReader {
 public:
  /// @param message  must outlive the reader; its descriptors are moved out.
  explicit FieldReader(Message& message) : message_(message), rest_(message.body) {}

  void number(std::uint64_t& value);
  void text(std::string& text);
  void bytes(std::vector<std::byte>& bytes);
  void descriptor(Descriptor& descriptor);
  /// Makes room in a list for `count` elements, each of which has at least one number, text, or row of bytes.
  template <class T>
  void resize(std::vector<T>& list, std::uint64_t count) {
    require(count <= rest_.size() / sizeof(std::uint64_t));
    list.resize(whole_ ? count : 0);
  }
  /// Notes a fault if the condition is false.
  void require(bool condition);

  /// Returns whether all fields were read and nothing is left over.
  [[nodiscard]] bool is_complete() const {
    return whole_ && rest_.empty() && used_ == message_.descriptors.size();
  }

 private:
  std::span<const std::byte> take(std::uint64_t count);
  std::span<const std::byte> take_counted();

  Message& message_;
  std::span<const std::byte> rest_;
  std::size_t used_ = 0;  // number of descriptors moved out
  bool whole_ = true;
};

}  // namespace orca::supervisor
