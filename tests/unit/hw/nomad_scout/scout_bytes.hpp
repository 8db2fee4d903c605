// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <string>
#include <utility>

#include "hex_bytes.hpp"
#include "orca/hw/nomad_scout/packet.hpp"

namespace orca::hw::test {

/// A message together with the bytes that it refers to.
struct HeldMessage {
  explicit HeldMessage(Bytes whole) : packet(std::move(whole)) {
    const auto found = nomad_scout::look(packet);
    REQUIRE(found.kind == framing::Finding::Kind::frame);
    REQUIRE(found.size == packet.size());
    message = nomad_scout::message_of(packet);
  }
  HeldMessage(const HeldMessage&) = delete;
  Bytes packet;
  nomad_scout::Message message;
};

/// The answer to GS that the manufacturer's client accepts.
inline const std::string kStateAnswer =
    "01 2C 00 07 14 15 16 17 18 19 1A 1B 1C 1D 1E 1F 20 21 22 23 00 00 00 7A 00 06 00 34 00 00 00 69 00 5F "
    "00 00 00 "
    "00 00 00 B0 06 00 00 C8 D2 B8 5C";

}  // namespace orca::hw::test
