// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>  // jpeglib.h needs it before
#include <cstdlib>
#include <vector>

#include <jpeglib.h>

namespace orca::test {

/// A picture of squares of 16 x 16 pixels, each of one colour, so that JPEG keeps all of them to within rounding.
/// @param seed  other colours.
inline std::vector<std::uint8_t> squares(std::size_t width, std::size_t height, unsigned seed = 0) {
  std::vector<std::uint8_t> rgb;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      for (unsigned channel = 0; channel < 3; ++channel)
        rgb.push_back(
            static_cast<std::uint8_t>(40 + (x / 16 * 37 + y / 16 * 59 + channel * 71 + seed * 13) % 180));
  return rgb;
}

struct JpegStyle {
  int quality = 100;
  bool progressive = false;
  bool grey = false;
};

/// Returns a picture as JPEG, with colours at half resolution, as cameras send them.
inline std::vector<std::uint8_t> jpeg_of(const std::vector<std::uint8_t>& rgb, std::size_t width,
                                         std::size_t height, const JpegStyle& style = {}) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = style.grey ? 1 : 3;
  jpeg.in_color_space = style.grey ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, style.quality, TRUE);
  if (style.progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  const std::size_t row = width * static_cast<std::size_t>(jpeg.input_components);
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* from = const_cast<JSAMPROW>(rgb.data() + jpeg.next_scanline * row);
    jpeg_write_scanlines(&jpeg, &from, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::vector<std::uint8_t> result(bytes, bytes + size);
  jpeg_destroy_compress(&jpeg);
  std::free(bytes);
  return result;
}

/// Returns the JPEG without its Huffman tables, as many cameras send it.
inline std::vector<std::uint8_t> without_tables(const std::vector<std::uint8_t>& jpeg) {
  std::vector<std::uint8_t> rest{jpeg[0], jpeg[1]};
  std::size_t at = 2;
  while (jpeg[at + 1] != 0xda) {  // up to the start of the scan
    const std::size_t length = 2U + (jpeg[at + 2] << 8U | jpeg[at + 3]);
    if (jpeg[at + 1] != 0xc4) rest.insert(rest.end(), jpeg.begin() + at, jpeg.begin() + at + length);
    at += length;
  }
  rest.insert(rest.end(), jpeg.begin() + at, jpeg.end());
  return rest;
}

}  // namespace orca::test
