// SPDX-License-Identifier: GPL-3.0-or-later
// Packets of secured participants that somebody sends once more.
#include "orca/dds/repeats.hpp"

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

using orca::dds::Repeats;

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kEncrypted = 0x33;
constexpr std::uint8_t kPlain = 0x15;

// A packet: an RTPS header, the head of its first submessage, and that of a cipher which ends in a number.
Bytes packet(std::uint8_t participant, std::uint8_t submessage, std::size_t number, std::uint8_t rest = 7) {
  Bytes bytes{'R', 'T', 'P', 'S', 2, 3, 1, 15};
  bytes.insert(bytes.end(), 12, participant);
  bytes.insert(bytes.end(), {submessage, 1, 20, 0});
  bytes.insert(bytes.end(), 18, 9);
  bytes.push_back(static_cast<std::uint8_t>(number >> 8));
  bytes.push_back(static_cast<std::uint8_t>(number));
  bytes.insert(bytes.end(), 40, rest);
  return bytes;
}

}  // namespace

TEST_CASE("an encrypted packet that comes once more is noticed, whoever comes between", "[dds][security]") {
  Repeats repeats;
  CHECK_FALSE(repeats.has_come(packet(1, kEncrypted, 1)));
  CHECK_FALSE(repeats.has_come(packet(1, kEncrypted, 2)));
  CHECK_FALSE(repeats.has_come(packet(2, kEncrypted, 1)));
  CHECK(repeats.has_come(packet(1, kEncrypted, 1)));
  CHECK(repeats.has_come(packet(1, kEncrypted, 1, 8)));  // whatever is behind the head
}

TEST_CASE("packets that are not encrypted as a whole, or cut, are none that repeat", "[dds][security]") {
  Repeats repeats;
  for (int i = 0; i < 2; ++i) {
    CHECK_FALSE(repeats.has_come(packet(1, kPlain, 1)));
    for (std::size_t size = 0; size < 44; ++size) {
      Bytes cut = packet(1, kEncrypted, 1);
      cut.resize(size);
      CHECK_FALSE(repeats.has_come(cut));
    }
  }
}

TEST_CASE("only the latest packets are remembered", "[dds][security]") {
  Repeats repeats;
  for (std::size_t i = 0; i <= Repeats::kRemembered; ++i)
    REQUIRE_FALSE(repeats.has_come(packet(1, kEncrypted, i)));
  CHECK(repeats.has_come(packet(1, kEncrypted, 1)));
  CHECK_FALSE(repeats.has_come(packet(1, kEncrypted, 0)));  // it was the first
}
