// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/supervisor/message.hpp"

namespace orca::supervisor {

inline constexpr std::size_t kPacketBytes = 128 * 1024;                   // longest packet
inline constexpr std::size_t kPacketDescriptors = 250;                    // Linux takes at most 253
inline constexpr std::size_t kLongestBody = std::size_t{64} << 20;        // [bytes] of a message
inline constexpr std::size_t kMostDescriptors = 16 * kPacketDescriptors;  // of a message

/// A part of a message, as the socket carries it. The first packet of a message begins with a head; each later one is
/// as long, and has as many descriptors, as the limits above allow.
struct Packet {
  std::vector<std::byte> bytes;
  std::vector<Descriptor> descriptors;
};

/// Cuts a message into packets.
/// @errors  invalid_argument if the message is longer than kLongestBody or has more than kMostDescriptors.
/// @thread  pure function; any thread.
[[nodiscard]] Result<std::deque<Packet>> split(Message message);

/// Joins packets to messages. The sender is not trusted: each length is checked, and no more memory is taken than has
/// arrived.
///
/// Thread contract: not synchronised.
class PacketJoiner {
 public:
  /// @param longest_body      [bytes] a longer message is impossible.
  /// @param most_descriptors  so is one with more of them.
  explicit PacketJoiner(std::size_t longest_body = kLongestBody,
                        std::size_t most_descriptors = kMostDescriptors)
      : longest_body_(longest_body), most_descriptors_(most_descriptors) {}

  /// Adds the next packet.
  /// @return the message that it completes; nothing if more packets are to come.
  /// @errors  data_loss if it cannot be the next packet. No packet may be added after that.
  Result<std::optional<Message>> add(std::span<const std::byte> bytes, std::vector<Descriptor> descriptors);

 private:
  Status begin(std::span<const std::byte>& bytes);
  Status append(std::span<const std::byte> bytes, std::size_t expected, std::vector<Descriptor> descriptors);

  const std::size_t longest_body_;
  const std::size_t most_descriptors_;
  std::optional<Message> message_;    // not yet complete
  std::size_t body_left_ = 0;         // [bytes] still to come
  std::size_t descriptors_left_ = 0;  // still to come
};

}  // namespace orca::supervisor
