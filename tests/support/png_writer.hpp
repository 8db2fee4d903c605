// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace orca::test {

/// Writes PNG pictures for tests without libpng, which the reader under test uses. The pixels are stored without
/// compression, each row without a filter (W3C, PNG Specification, 2nd edition, 5, 10 and 11; RFC 1950 and 1951).
enum class PngColour { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgb_alpha = 6 };

/// Returns a number as `bytes` bytes, the highest first.
inline std::string big_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

inline std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

inline std::string png_chunk(const std::string& name, const std::string& content) {
  const auto length = static_cast<std::uint32_t>(content.size());
  return big_endian(length, 4) + name + content + big_endian(crc_of(name + content), 4);
}

/// Returns a zlib stream of one stored block, which holds at most 65535 bytes.
inline std::string stored(const std::string& bytes) {
  std::uint32_t sum = 1;
  std::uint32_t sum_of_sums = 0;
  for (const char c : bytes) {
    sum = (sum + static_cast<unsigned char>(c)) % 65521;
    sum_of_sums = (sum_of_sums + sum) % 65521;
  }
  const auto length = static_cast<std::uint32_t>(bytes.size());
  const auto low_first = [](std::uint32_t v) {
    return std::string{static_cast<char>(v & 0xFFU), static_cast<char>(v >> 8 & 0xFFU)};
  };
  return "\x78\x01\x01" + low_first(length) + low_first(~length) + bytes +
         big_endian(sum_of_sums << 16 | sum, 4);
}

/// Tags that may stand before the pixels.
inline std::string gamma_tag(double gamma) {
  return png_chunk("gAMA", big_endian(static_cast<std::uint32_t>(std::lround(gamma * 1e5)), 4));
}
inline std::string srgb_tag() { return png_chunk("sRGB", std::string(1, '\0')); }

/// Returns a whole picture of one row.
///
/// @param samples  the numbers of its pixels from the left, for example red, green and blue of the first.
/// @param tags     chunks before the pixels, among them "PLTE" and "tRNS".
inline std::string png_row(PngColour colour, int depth, const std::vector<std::uint32_t>& samples,
                           const std::string& tags = "") {
  constexpr std::array<std::size_t, 7> kSamplesOfPixel{1, 0, 3, 1, 2, 0, 4};
  const std::size_t width = samples.size() / kSamplesOfPixel.at(static_cast<std::size_t>(colour));
  std::string row(1, '\0');
  std::uint32_t bits = 0;
  int count = 0;
  for (const std::uint32_t sample : samples) {
    bits = bits << depth | sample;
    count += depth;
    if (count < 8) continue;
    row += big_endian(bits, count / 8);
    bits = 0;
    count = 0;
  }
  if (count > 0) row += big_endian(bits << (8 - count), 1);
  const std::string header = big_endian(static_cast<std::uint32_t>(width), 4) + big_endian(1, 4) +
                             static_cast<char>(depth) + static_cast<char>(colour) + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + tags + png_chunk("IDAT", stored(row)) +
         png_chunk("IEND", "");
}

}  // namespace orca::test
