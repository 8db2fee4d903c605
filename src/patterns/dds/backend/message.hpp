// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace orca::dds {

/// Room before the contents of what a reader has received [bytes], so that they can become a frame where they are.
constexpr std::size_t kHeadroom = 4 * sizeof(std::uint64_t);

/// A message between two processes. On the wire it is its size without this number, its five numbers, 64 bits each, and the
/// parcel. A sample of DDS holds one message or several.
struct Message {
  std::uint64_t from = 0;      ///< Identifies the sender by the hash of its name.
  std::uint64_t own = 0;       ///< The number by which the sender takes part at present.
  std::uint64_t peer = 0;      ///< The receiver's such number, as far as the sender knows it; 0: not yet.
  std::uint64_t sequence = 0;  ///< The parcel's, from 1 in each session; 0: there is none.
  std::uint64_t received = 0;  ///< Sequence number of the last parcel that the sender has received in order.
  std::span<const std::byte> parcel{};
};

/// Returns the encoded message.
[[nodiscard]] std::vector<std::byte> encode(const Message& message);

/// Takes the first message off a sample. Its parcel is a view of the bytes. Nothing if there is none, or none that is whole.
[[nodiscard]] std::optional<Message> take_message(std::span<const std::byte>& sample);

/// The message of a parcel to the end of an edge. On the wire a parcel is the number of the edge, the kind, 64 bits each, and the
/// contents.
enum class Parcel : std::uint64_t {
  frame = 1,  ///< A frame.
  closed,     ///< The sender's end has gone, or has cut off this one.
  heard,      ///< Push, client: an object has come through the data topic, so it works.
  direct,     ///< Push, server: from here on objects come through the data topic. Subscription, bit, epoch.
};

/// Returns the beginning of a parcel, to which its contents are appended.
[[nodiscard]] std::vector<std::byte> begin_parcel(std::uint64_t edge, Parcel kind);

/// A parcel that was received: a view.
struct OpenParcel {
  std::uint64_t edge;
  Parcel kind;
  std::span<const std::byte> contents;
};

/// Returns the parts of a parcel; nothing if it is none.
[[nodiscard]] std::optional<OpenParcel> open_parcel(std::span<const std::byte> parcel);

/// Appends a number, little-endian.
void append(std::vector<std::byte>& bytes, std::uint64_t number);

/// Takes a number from the beginning of the bytes; nothing if there are too few.
[[nodiscard]] std::optional<std::uint64_t> take_number(std::span<const std::byte>& bytes);

}  // namespace orca::dds
