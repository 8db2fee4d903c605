// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include "hex_bytes.hpp"
#include "orca/hw/framing/checksums.hpp"
#include "orca/hw/sick_lms/reply.hpp"

/// Telegrams from a laser, in tests.
namespace orca::hw::test {

/// A reply together with the bytes that it refers to.
struct HeldReply {
  explicit HeldReply(Bytes whole) : telegram(std::move(whole)) {
    const auto found = sick_lms::look_from_laser(telegram);
    REQUIRE(found.kind == framing::Finding::Kind::frame);
    REQUIRE(found.size == telegram.size());
    reply = sick_lms::parse_reply(sick_lms::payload_of(telegram)).value();
  }
  HeldReply(const HeldReply&) = delete;
  Bytes telegram;
  sick_lms::Reply reply;
};

/// Returns the telegram from a laser around a payload.
[[nodiscard]] inline Bytes from_laser(const Bytes& payload) {
  const auto size = static_cast<unsigned>(payload.size());
  Bytes telegram = joined(
      {{0x02, 0x80, static_cast<std::uint8_t>(size & 0xFF), static_cast<std::uint8_t>(size >> 8)}, payload});
  const unsigned crc = framing::crc_of_pairs(telegram);
  telegram.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  telegram.push_back(static_cast<std::uint8_t>(crc >> 8));
  return telegram;
}

}  // namespace orca::hw::test
