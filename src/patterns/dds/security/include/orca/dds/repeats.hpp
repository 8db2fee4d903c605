// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <unordered_set>

namespace orca::dds {

/// Notices encrypted packets that come once more. A sender ciphers no two packets with one initialization vector, also where it says the same again, so
/// only somebody who has recorded a packet sends it twice, or a network that brings it by two ways. Fast DDS 2.9.1 takes nothing twice, and says
/// nothing of it.
///
/// Thread contract: a plain value.
/// @source  OMG DDS Security 1.1, 9.5.3.3.1 (CryptoHeader) and 7.3.6.2 (SecureRTPSPrefixSubMsg).
class Repeats {
 public:
  static constexpr std::size_t kRemembered = 8'192;  ///< Packets; an older one is taken for new.

  /// Returns whether this packet is among the last that were asked about; false for what is not encrypted as a whole.
  [[nodiscard]] bool has_come(std::span<const std::uint8_t> packet);

 private:
  std::unordered_set<std::uint64_t> known_;  // hashes of sender and cipher head
  std::deque<std::uint64_t> in_order_;
};

}  // namespace orca::dds
