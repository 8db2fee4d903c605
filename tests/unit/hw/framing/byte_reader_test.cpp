// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cstdint>
#include <vector>

#include "orca/hw/framing/byte_reader.hpp"

using orca::hw::framing::ByteReader;
using ReaderInput = std::vector<std::uint8_t>;

TEST_CASE("numbers are read with their low byte first", "[hw][framing]") {
  const ReaderInput bytes{0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07};
  ByteReader reader(bytes);
  CHECK(reader.u8() == 0x01);
  CHECK(reader.u16() == 0x0302);
  CHECK(reader.u32() == 0x07060504U);
  CHECK(reader.remaining() == 0);
}

TEST_CASE("signed numbers are in two's complement", "[hw][framing]") {
  const ReaderInput bytes{0xFF, 0xFE, 0xFF, 0x18, 0xFC, 0xFF, 0xFF};
  ByteReader reader(bytes);
  CHECK(reader.s8() == -1);
  CHECK(reader.s16() == -2);
  CHECK(reader.s32() == -1000);
}

TEST_CASE("what lies behind the last byte reads as zeros", "[hw][framing]") {
  const ReaderInput bytes{0x12};
  ByteReader reader(bytes);
  CHECK(reader.u16() == 0x0012);
  CHECK(reader.u32() == 0);
  CHECK(reader.s8() == 0);
  CHECK(reader.text_to_zero().empty());
  CHECK(reader.bytes(3).empty());
}

TEST_CASE("texts end at a zero byte or at the end", "[hw][framing]") {
  const ReaderInput bytes{'a', 'b', 0, 0, 'c'};
  ByteReader reader(bytes);
  CHECK(reader.text_to_zero() == "ab");
  CHECK(reader.text_to_zero().empty());
  CHECK(reader.text_to_zero() == "c");
  CHECK(reader.remaining() == 0);
}
