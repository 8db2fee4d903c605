// SPDX-License-Identifier: LGPL-3.0-or-later
#include "channel/packets.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <string>
#include <utility>

namespace orca::supervisor {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as the machine holds them");

// The first byte of each packet.
enum class Tag : std::uint8_t { first = 0xC1, next = 0xC2 };

// What follows the tag of a first packet.
struct Head {
  std::uint64_t request;
  std::uint32_t body;  // [bytes] of the whole message
  std::uint32_t descriptors;
  Kind kind;
};
constexpr std::size_t kTagBytes = 1;
constexpr std::size_t kHeadBytes =
    sizeof Head::request + sizeof Head::body + sizeof Head::descriptors + sizeof Head::kind;

template <class T>
void append_plain(std::vector<std::byte>& to, T value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  to.insert(to.end(), bytes.begin(), bytes.end());
}

template <class T>
T take_plain(std::span<const std::byte>& from) {
  T value{};
  std::memcpy(&value, from.data(), sizeof value);
  from = from.subspan(sizeof value);
  return value;
}

void append_head(std::vector<std::byte>& to, const Message& message) {
  append_plain(to, message.request);
  append_plain(to, static_cast<std::uint32_t>(message.body.size()));
  append_plain(to, static_cast<std::uint32_t>(message.descriptors.size()));
  append_plain(to, message.kind);
}

Head take_head(std::span<const std::byte>& from) {
  Head head{};
  head.request = take_plain<std::uint64_t>(from);
  head.body = take_plain<std::uint32_t>(from);
  head.descriptors = take_plain<std::uint32_t>(from);
  head.kind = take_plain<Kind>(from);
  return head;
}

// Number of body bytes in a packet of which so many bytes are taken.
std::size_t body_share(std::size_t taken, std::size_t left) { return std::min(kPacketBytes - taken, left); }

Error impossible(const std::string& what) {
  return fail(Code::data_loss, "a packet of the control channel " + what);
}

}  // namespace

Result<std::deque<Packet>> split(Message message) {
  if (message.body.size() > kLongestBody || message.descriptors.size() > kMostDescriptors)
    return fail(Code::invalid_argument, "a message of " + std::to_string(message.body.size()) +
                                            " bytes and " + std::to_string(message.descriptors.size()) +
                                            " descriptors; a control channel carries at most " +
                                            std::to_string(kLongestBody) + " and " +
                                            std::to_string(kMostDescriptors));
  std::deque<Packet> packets;
  auto body = std::span<const std::byte>(message.body);
  auto descriptor = message.descriptors.begin();
  do {
    Packet packet;
    append_plain(packet.bytes, packets.empty() ? Tag::first : Tag::next);
    if (packets.empty()) append_head(packet.bytes, message);
    const std::size_t count = body_share(packet.bytes.size(), body.size());
    packet.bytes.insert(packet.bytes.end(), body.begin(), body.begin() + static_cast<std::ptrdiff_t>(count));
    body = body.subspan(count);
    for (; descriptor != message.descriptors.end() && packet.descriptors.size() < kPacketDescriptors;
         ++descriptor)
      packet.descriptors.push_back(std::move(*descriptor));
    packets.push_back(std::move(packet));
  } while (!body.empty() || descriptor != message.descriptors.end());
  return packets;
}

Result<std::optional<Message>> PacketJoiner::add(std::span<const std::byte> bytes,
                                                 std::vector<Descriptor> descriptors) {
  if (bytes.empty()) return impossible("is empty");
  const auto tag = take_plain<Tag>(bytes);
  if (tag != (message_ ? Tag::next : Tag::first)) return impossible("is out of order");
  std::size_t taken = kTagBytes;
  if (!message_) {
    if (Status begun = begin(bytes); !begun.ok()) return begun.error();
    taken += kHeadBytes;
  }
  const std::size_t share = body_share(taken, body_left_);
  if (Status appended = append(bytes, share, std::move(descriptors)); !appended.ok()) return appended.error();
  if (body_left_ > 0 || descriptors_left_ > 0) return std::optional<Message>{};
  return std::exchange(message_, std::nullopt);
}

Status PacketJoiner::begin(std::span<const std::byte>& bytes) {
  if (bytes.size() < kHeadBytes) return impossible("has an incomplete head");
  const Head head = take_head(bytes);
  if (head.body > longest_body_ || head.descriptors > most_descriptors_)
    return impossible("announces " + std::to_string(head.body) + " bytes and " +
                      std::to_string(head.descriptors) + " descriptors");
  message_.emplace(Message{head.kind, head.request, {}, {}});
  body_left_ = head.body;
  descriptors_left_ = head.descriptors;
  return ok();
}

Status PacketJoiner::append(std::span<const std::byte> bytes, std::size_t expected,
                            std::vector<Descriptor> descriptors) {
  if (bytes.size() != expected)
    return impossible("has " + std::to_string(bytes.size()) + " bytes of a message, expected " +
                      std::to_string(expected));
  const std::size_t share = std::min(descriptors_left_, kPacketDescriptors);
  if (descriptors.size() != share)
    return impossible("has " + std::to_string(descriptors.size()) + " descriptors, expected " +
                      std::to_string(share));
  message_->body.insert(message_->body.end(), bytes.begin(), bytes.end());
  std::ranges::move(descriptors, std::back_inserter(message_->descriptors));
  body_left_ -= bytes.size();
  descriptors_left_ -= descriptors.size();
  return ok();
}

}  // namespace orca::supervisor
