// SPDX-License-Identifier: LGPL-3.0-or-later
#include "introductions.hpp"

#include <algorithm>
#include <utility>

namespace orca::dds {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostKept = 32;        // packets
constexpr std::size_t kMostAnnounced = 512;  // participants
constexpr auto kPatience = 1s;               // after which a message is repeated anyway

// DDSI-RTPS 2.3: 9.4.4, 9.4.5.1, 9.4.5.3; entities: 9.3.1.3, and DDS Security 1.1, table 14.
constexpr std::size_t kRtpsHeader = 20;
constexpr std::size_t kSender = 8;
constexpr std::size_t kSubmessageHeader = 4;
constexpr std::size_t kWriter = 12;  // from the beginning of a submessage with data
constexpr std::uint8_t kData = 0x15;
using Entity = std::array<std::uint8_t, 4>;
constexpr Entity kAnnouncer{0x00, 0x01, 0x00, 0xC2};
constexpr Entity kHandshaker{0x00, 0x02, 0x01, 0xC3};

// Returns whether a packet has data of a writer.
bool has_data_of(const Entity& writer, std::span<const std::uint8_t> packet) {
  for (std::size_t at = kRtpsHeader; at + kSubmessageHeader <= packet.size();) {
    const auto submessage = packet.subspan(at);
    if (submessage[0] == kData && submessage.size() >= kWriter + writer.size() &&
        std::ranges::equal(submessage.subspan(kWriter, writer.size()), writer))
      return true;
    const bool is_little = (submessage[1] & 1U) != 0;
    const unsigned low = submessage[is_little ? 2 : 3];
    const unsigned high = submessage[is_little ? 3 : 2];
    const unsigned length = high << 8U | low;
    if (length == 0) return false;  // it is the last one
    at += kSubmessageHeader + length;
  }
  return false;
}

}  // namespace

void Introductions::pass(std::span<const std::uint8_t> packet, Receiver& receiver, const Locator& here,
                         const Locator& sender) {
  const auto deliver = [&] {
    receiver.OnDataReceived(packet.data(), static_cast<std::uint32_t>(packet.size()), here, sender);
  };
  const bool announces = has_data_of(kAnnouncer, packet);
  if (!announces && !has_data_of(kHandshaker, packet)) return deliver();
  Prefix prefix{};
  std::copy_n(packet.begin() + kSender, prefix.size(), prefix.begin());
  const MutexLock lock(mutex_);
  if (!announces && !announced_.contains(prefix))
    return keep({{packet.begin(), packet.end()}, &receiver, here, sender, Clock::now()});
  deliver();
  if (!announces) return;
  if (announced_.size() >= kMostAnnounced) announced_.clear();
  if (announced_.insert(prefix).second) pass_kept(prefix);
}

void Introductions::keep(Packet packet) {
  std::erase_if(kept_, [&](const Packet& old) { return packet.came - old.came > kPatience; });
  if (kept_.size() < kMostKept) kept_.push_back(std::move(packet));
}

void Introductions::pass_kept(const Prefix& sender) {
  const auto is_due = [&](const Packet& packet) {
    return std::equal(sender.begin(), sender.end(), packet.bytes.begin() + kSender);
  };
  for (const Packet& packet : kept_)
    if (is_due(packet))
      packet.receiver->OnDataReceived(packet.bytes.data(), static_cast<std::uint32_t>(packet.bytes.size()),
                                      packet.here, packet.sender);
  std::erase_if(kept_, is_due);
}

}  // namespace orca::dds
