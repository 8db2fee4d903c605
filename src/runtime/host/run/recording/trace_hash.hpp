// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace orca::host {

/// The hash of a trace, fed piece by piece: FNV-1a with steps of eight bytes in place of one, since it sees each byte of each delivery.
/// Such a step multiplies by a number of 64 bits, and folds the upper half into the lower one. Otherwise a bit would only change those
/// above it, and two values that both change their signs would leave the hash as it is.
///
/// Thread contract: a plain value.
/// @source  Fowler, Noll, Vo: draft-eastlake-fnv; the factor is that of Knuth, The Art of Computer Programming 3, 6.4.
class TraceHash {
 public:
  void add_u64(std::uint64_t word) {
    hash_ = (hash_ ^ word) * kFactor;
    hash_ ^= hash_ >> 32;
  }
  /// Adds the number of bytes, and then the bytes in little-endian words, of which the last is filled up by zeros.
  void add(std::span<const std::byte> bytes) {
    static_assert(std::endian::native == std::endian::little);
    add_u64(bytes.size());
    for (std::uint64_t word = 0; !bytes.empty(); word = 0) {
      const std::size_t size = std::min(bytes.size(), sizeof word);
      if (size == sizeof word)
        std::memcpy(&word, bytes.data(), sizeof word);  // one instruction, as its size is known here
      else
        std::memcpy(&word, bytes.data(), size);
      add_u64(word);
      bytes = bytes.subspan(size);
    }
  }
  void add_text(std::string_view text) { add(std::as_bytes(std::span(text))); }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  static constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15ULL;
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace orca::host
