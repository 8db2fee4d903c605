// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace orca::hw::camera {

/// What the bytes of a camera's picture mean. Names are those of Video4Linux2, where each is described.
enum class PixelFormat {
  grey,   ///< GREY: 1 byte per pixel, its luma.
  yuyv,   ///< YUYV: 4 bytes per two pixels: luma, blue difference, luma, red difference.
  nv12,   ///< NV12: a plane of luma, then one of pairs (blue, red difference), a pair per 2 x 2 pixels.
  rgb24,  ///< RGB3: 3 bytes per pixel: red, green, blue.
  bgr24,  ///< BGR3: 3 bytes per pixel: blue, green, red.
  mjpeg,  ///< MJPG, JPEG: each picture is a JPEG file.
};

/// What is made of it: the number of bytes per pixel.
enum class Channels : std::size_t {
  grey = 1,  ///< Brightness, 0 to 255.
  rgb = 3,   ///< Red, green, blue, 0 to 255.
};

/// How the bytes of a picture lie. A plain value.
struct Layout {
  PixelFormat format = PixelFormat::rgb24;
  std::size_t width = 0;   ///< Pixels in a row.
  std::size_t height = 0;  ///< Rows.
  std::size_t step = 0;    ///< Bytes from one row to the next; of mjpeg not used.
  bool full_range =
      false;  ///< Whether luma goes from 0 to 255, instead of 16 to 235, and the differences likewise.
  friend bool operator==(const Layout&, const Layout&) = default;
};

/// Returns the number of bytes that a row must have at least; of mjpeg 0.
/// @thread  pure function; any.
[[nodiscard]] std::size_t least_step(const Layout& layout);

/// Returns how many bytes a whole picture has; of mjpeg 0: it depends on the picture.
/// @pre  layout.step is at least least_step(layout).
/// @thread  pure function; any.
[[nodiscard]] std::size_t bytes_of_picture(const Layout& layout);

/// Converts a picture that is not mjpeg, in fixed-point arithmetic: each value is that of the real formula, rounded to the nearest
/// whole number, or at most one beside it. Rows of the result follow each other without a gap.
///
/// @param raw   at least bytes_of_picture(layout).
/// @param into  layout.width * layout.height pixels of that many channels.
/// @return whether raw and into have enough bytes; otherwise nothing is done.
/// @thread  any.
/// @source  ITU-R BT.601-7, 2.5.1 (luma and colour differences) and 2.5.3 (quantization).
[[nodiscard]] bool convert(const Layout& layout, std::span<const std::uint8_t> raw, Channels channels,
                           std::span<std::uint8_t> into);

}  // namespace orca::hw::camera
