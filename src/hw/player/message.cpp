// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/player/message.hpp"

#include <algorithm>
#include <string>

#include "fields.hpp"
#include "orca/base/text.hpp"

namespace orca::hw::player {
namespace {

// Kept as a number while it is read, so that the error can name it.
struct RawHeader {
  Header header;
  std::uint32_t type = 0;
};

template <class Xdr, class Raw>
void fields_of_header(Xdr& xdr, Raw& raw) {
  auto& header = raw.header;
  xdr.all(header.address, raw.type, header.subtype, header.time, header.sequence, header.size);
}

constexpr std::string_view kBannerStart = "Player v.";

}  // namespace

std::array<std::uint8_t, kHeaderSize> encode_header(const Header& header) {
  XdrWriter writer;
  const RawHeader raw{header, static_cast<std::uint32_t>(header.type)};
  fields_of_header(writer, raw);
  const std::vector<std::uint8_t> bytes = std::move(writer).take();
  std::array<std::uint8_t, kHeaderSize> encoded{};
  std::ranges::copy(bytes, encoded.begin());
  return encoded;
}

Result<Header> decode_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeaderSize)
    return fail(Code::data_loss,
                "a Player header has 40 bytes, but only " + std::to_string(bytes.size()) + " have arrived");
  XdrReader reader(bytes.first(kHeaderSize));
  RawHeader raw;
  fields_of_header(reader, raw);
  if (raw.type < 1 || raw.type > 6)
    return fail(Code::data_loss,
                "message type " + std::to_string(raw.type) +
                    " does not exist in Player; close the connection and check that the peer speaks "
                    "Player 3.x");
  raw.header.type = static_cast<MessageType>(raw.type);
  if (raw.header.size > kLongestPayload)
    return fail(Code::data_loss,
                "a payload of " + std::to_string(raw.header.size) +
                    " bytes is announced, more than a Player message of 8 MiB can have; close the "
                    "connection and check that the peer speaks Player 3.x");
  return raw.header;
}

Result<std::vector<std::uint8_t>> make_message(Header header, std::span<const std::uint8_t> payload) {
  if (payload.size() > kLongestPayload)
    return fail(Code::invalid_argument,
                "a payload of " + std::to_string(payload.size()) +
                    " bytes does not fit into a Player message of 8 MiB; send less at a time");
  header.size = static_cast<std::uint32_t>(payload.size());
  const auto encoded = encode_header(header);
  std::vector<std::uint8_t> message(encoded.begin(), encoded.end());
  message.insert(message.end(), payload.begin(), payload.end());
  return message;
}

std::array<std::uint8_t, kBannerSize> make_banner(std::string_view version) {
  std::array<std::uint8_t, kBannerSize> banner{};
  const auto end = std::ranges::copy(kBannerStart, banner.begin()).out;
  std::ranges::copy(version.substr(0, kBannerSize - kBannerStart.size() - 1), end);
  return banner;
}

Result<std::string> parse_banner(std::span<const std::uint8_t> banner) {
  if (banner.size() < kBannerSize)
    return fail(Code::data_loss, "the banner of a Player server has 32 bytes, but only " +
                                     std::to_string(banner.size()) + " have arrived");
  const auto characters = banner.first(kBannerSize);
  const std::string text(characters.begin(), std::ranges::find(characters, std::uint8_t{0}));
  if (!text.starts_with(kBannerStart))
    return fail(Code::invalid_argument, "the server begins with " + in_quotes(printable(text)) +
                                            " and not with \"Player v.\"; check host and port");
  return text.substr(kBannerStart.size());
}

}  // namespace orca::hw::player
