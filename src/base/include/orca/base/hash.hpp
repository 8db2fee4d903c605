// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace orca {

/// A 64-bit FNV-1a hash, fed piece by piece. Numbers are hashed in little-endian order, so the value is the
/// same on every machine.
///
/// Thread contract: a plain value.
/// @source  Fowler, Noll, Vo; draft-eastlake-fnv, offset basis and prime for 64 bits.
class Fnv1a {
 public:
  void add(std::span<const std::byte> bytes) {
    for (; bytes.size() >= kWord; bytes = bytes.subspan(kWord)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data(), kWord);
      if (word == 0)
        hash_ *= kOfEightZeros;  // the free cells of a map, or a covariance: eight steps in one
      else
        for (std::size_t i = 0; i < kWord; ++i) step(static_cast<std::uint8_t>(bytes[i]));
    }
    for (const std::byte b : bytes) step(static_cast<std::uint8_t>(b));
  }
  void add_u64(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) step(static_cast<std::uint8_t>(value >> shift));
  }
  /// Adds the characters and a zero, so that ("ab", "c") and ("a", "bc") differ.
  void add_text(std::string_view text) {
    for (const char c : text) step(static_cast<std::uint8_t>(c));
    step(0);
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  void step(std::uint8_t byte) {
    hash_ ^= byte;
    hash_ *= kPrime;
  }

  static constexpr std::size_t kWord = sizeof(std::uint64_t);
  static constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  static constexpr std::uint64_t kOfTwoZeros = kPrime * kPrime;
  static constexpr std::uint64_t kOfEightZeros = kOfTwoZeros * kOfTwoZeros * kOfTwoZeros * kOfTwoZeros;
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace orca
