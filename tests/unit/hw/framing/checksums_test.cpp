// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cstdint>
#include <vector>

#include "orca/hw/framing/checksums.hpp"

using namespace orca::hw::framing;
using ChecksumInput = std::vector<std::uint8_t>;

TEST_CASE("the sum of words takes the first byte of each pair as the high one", "[hw][framing]") {
  CHECK(sum_of_words(ChecksumInput{0x0B, 0x3B, 0xC8, 0x00}) == 0xD33B);
}

TEST_CASE("the sum of words ends with an exclusive or of the odd byte", "[hw][framing]") {
  CHECK(sum_of_words(ChecksumInput{0x07}) == 0x0007);
  CHECK(sum_of_words(ChecksumInput{0x07, 0x3B, 0x3B}) == 0x0700);
}

TEST_CASE("the sum of words forgets what exceeds 16 bits", "[hw][framing]") {
  CHECK(sum_of_words(ChecksumInput{0xFF, 0xFF, 0x00, 0x02}) == 0x0001);
}

TEST_CASE("the check word of a telegram is that of the telegram listing", "[hw][framing]") {
  CHECK(crc_of_pairs(ChecksumInput{0x02, 0x00, 0x01, 0x00, 0x31}) == 0x1215);
  CHECK(crc_of_pairs(ChecksumInput{0x02, 0x80, 0x03, 0x00, 0xA0, 0x00, 0x10}) == 0x0A16);
}

TEST_CASE("the sum of bytes is that of the Scout's packets", "[hw][framing]") {
  CHECK(sum_of_bytes(ChecksumInput{0x01, 0x02, 0x00, 0x07}) == 0x0A);
  CHECK(sum_of_bytes(ChecksumInput{0xFF, 0x02}) == 0x01);
}

TEST_CASE("the CRC-16 of the digits 1 to 9 is the catalogue's check value", "[hw][framing]") {
  CHECK(crc_ccitt(ChecksumInput{'1', '2', '3', '4', '5', '6', '7', '8', '9'}) == 0x29B1);
  CHECK(crc_ccitt({}) == 0xFFFF);
}

TEST_CASE("the checksum of nothing is 0", "[hw][framing]") {
  CHECK(sum_of_words({}) == 0);
  CHECK(crc_of_pairs({}) == 0);
  CHECK(sum_of_bytes({}) == 0);
}
