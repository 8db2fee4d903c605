// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/dds/repeats.hpp"

#include "orca/base/hash.hpp"

namespace orca::dds {
namespace {

constexpr std::size_t kSenderAt = 8;                       // [bytes] where the sender's GUID begins,
constexpr std::size_t kSenderSize = 12;                    // and those of it that a packet says
constexpr std::size_t kFirstSubmessage = 20;               // where the first submessage begins
constexpr std::size_t kCipherHead = kFirstSubmessage + 4;  // where the head of its cipher is:
constexpr std::size_t kCipherHeadSize = 20;                // kind, key, session, initialization vector
constexpr std::uint8_t kSecuredPacket = 0x33;              // SRTPS_PREFIX

}  // namespace

bool Repeats::has_come(std::span<const std::uint8_t> packet) {
  if (packet.size() < kCipherHead + kCipherHeadSize || packet[kFirstSubmessage] != kSecuredPacket)
    return false;
  Fnv1a hash;
  hash.add(std::as_bytes(packet.subspan(kSenderAt, kSenderSize)));
  hash.add(std::as_bytes(packet.subspan(kCipherHead, kCipherHeadSize)));
  if (!known_.insert(hash.value()).second) return true;
  in_order_.push_back(hash.value());
  if (in_order_.size() > kRemembered) {
    known_.erase(in_order_.front());
    in_order_.pop_front();
  }
  return false;
}

}  // namespace orca::dds
