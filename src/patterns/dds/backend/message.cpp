// SPDX-License-Identifier: LGPL-3.0-or-later
#include "message.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace orca::dds {

static_assert(std::endian::native == std::endian::little, "numbers are written as the machine holds them");

void append(std::vector<std::byte>& bytes, std::uint64_t number) {
  const std::size_t size = bytes.size();
  bytes.resize(size + sizeof number);
  std::memcpy(bytes.data() + size, &number, sizeof number);
}

std::optional<std::uint64_t> take_number(std::span<const std::byte>& bytes) {
  std::uint64_t number = 0;
  if (bytes.size() < sizeof number) return std::nullopt;
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes = bytes.subspan(sizeof number);
  return number;
}

std::vector<std::byte> encode(const Message& message) {
  const std::uint64_t size = 5 * sizeof(std::uint64_t) + message.parcel.size();
  const std::array head{size, message.from, message.own, message.peer, message.sequence, message.received};
  std::vector<std::byte> bytes;
  bytes.reserve(sizeof head + message.parcel.size());
  for (const std::uint64_t number : head) append(bytes, number);
  bytes.insert(bytes.end(), message.parcel.begin(), message.parcel.end());
  return bytes;
}

std::optional<Message> take_message(std::span<const std::byte>& sample) {
  const auto size = take_number(sample);
  if (!size || *size > sample.size()) return std::nullopt;
  std::span<const std::byte> bytes = sample.first(*size);
  sample = sample.subspan(*size);
  std::array<std::uint64_t, 5> head{};
  for (std::uint64_t& number : head) {
    const auto taken = take_number(bytes);
    if (!taken) return std::nullopt;
    number = *taken;
  }
  if (head[1] == 0) return std::nullopt;
  return Message{head[0], head[1], head[2], head[3], head[4], bytes};
}

std::vector<std::byte> begin_parcel(std::uint64_t edge, Parcel kind) {
  std::vector<std::byte> parcel;
  append(parcel, edge);
  append(parcel, static_cast<std::uint64_t>(kind));
  return parcel;
}

std::optional<OpenParcel> open_parcel(std::span<const std::byte> parcel) {
  const auto edge = take_number(parcel);
  const auto kind = take_number(parcel);
  if (!edge || !kind || *kind < static_cast<std::uint64_t>(Parcel::frame) ||
      *kind > static_cast<std::uint64_t>(Parcel::direct))
    return std::nullopt;
  return OpenParcel{*edge, static_cast<Parcel>(*kind), parcel};
}

}  // namespace orca::dds
