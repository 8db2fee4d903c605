// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/camera/pixels.hpp"

#include <algorithm>
#include <cstring>

namespace orca::hw::camera {
namespace {

using Byte = std::uint8_t;

constexpr int kBits = 16;  // behind the point of a fixed-point number

constexpr int fixed(double value) {
  return static_cast<int>(value * (1 << kBits) + (value < 0.0 ? -0.5 : 0.5));
}

constexpr int rounded(int value) { return (value + (1 << (kBits - 1))) >> kBits; }

constexpr Byte byte_of(int value) { return static_cast<Byte>(std::clamp(rounded(value), 0, 255)); }

// The weights of red and blue in luma; the rest is that of green.
constexpr double kRed = 0.299;
constexpr double kBlue = 0.114;
constexpr double kGreen = 1.0 - kRed - kBlue;

/// Luma and colour differences to red, green and blue.
struct Matrix {
  int black;       // luma of black
  int luma;        // factors, fixed-point
  int red_of_red;  // of the red difference in red
  int green_of_blue, green_of_red;
  int blue_of_blue;

  constexpr Matrix(int black_level, double luma_span, double difference_span)
      : black(black_level),
        luma(fixed(255.0 / luma_span)),
        red_of_red(fixed(255.0 / difference_span * 2.0 * (1.0 - kRed))),
        green_of_blue(fixed(-255.0 / difference_span * 2.0 * (1.0 - kBlue) * kBlue / kGreen)),
        green_of_red(fixed(-255.0 / difference_span * 2.0 * (1.0 - kRed) * kRed / kGreen)),
        blue_of_blue(fixed(255.0 / difference_span * 2.0 * (1.0 - kBlue))) {}
};

constexpr Matrix kLimited(16, 219.0, 224.0);
constexpr Matrix kFull(0, 255.0, 255.0);

const Matrix& matrix_of(const Layout& layout) { return layout.full_range ? kFull : kLimited; }

void write_rgb(const Matrix& matrix, int y, int cb, int cr, Byte* to) {
  const int light = matrix.luma * (y - matrix.black);
  to[0] = byte_of(light + matrix.red_of_red * (cr - 128));
  to[1] = byte_of(light + matrix.green_of_blue * (cb - 128) + matrix.green_of_red * (cr - 128));
  to[2] = byte_of(light + matrix.blue_of_blue * (cb - 128));
}

// Writes the brightness of each pixel of a row of luma, `stride` bytes apart, to one byte or to three equal ones.
void luma_row(const Layout& layout, const Byte* from, std::size_t stride, std::size_t copies, Byte* to) {
  const Matrix& matrix = matrix_of(layout);
  for (std::size_t x = 0; x < layout.width; ++x)
    for (std::size_t k = 0; k < copies; ++k)
      *to++ = byte_of(matrix.luma * (static_cast<int>(from[x * stride]) - matrix.black));
}

void yuyv_row(const Layout& layout, const Byte* from, Byte* to) {
  const Matrix& matrix = matrix_of(layout);
  for (std::size_t x = 0; x < layout.width; ++x) {
    const Byte* const pair = from + x / 2 * 4;
    write_rgb(matrix, pair[x % 2 * 2], pair[1], pair[3], to + 3 * x);
  }
}

void nv12_row(const Layout& layout, const Byte* luma, const Byte* differences, Byte* to) {
  const Matrix& matrix = matrix_of(layout);
  for (std::size_t x = 0; x < layout.width; ++x) {
    const Byte* const pair = differences + x / 2 * 2;
    write_rgb(matrix, luma[x], pair[0], pair[1], to + 3 * x);
  }
}

// @param red  where red is in a pixel: 0 or 2.
void grey_of_rgb_row(const Layout& layout, const Byte* from, std::size_t red, Byte* to) {
  constexpr int kRedPart = fixed(kRed);
  constexpr int kBluePart = fixed(kBlue);
  constexpr int kGreenPart = (1 << kBits) - kRedPart - kBluePart;
  for (std::size_t x = 0; x < layout.width; ++x, from += 3)
    to[x] = byte_of(kRedPart * from[red] + kGreenPart * from[1] + kBluePart * from[2 - red]);
}

void swapped_row(const Layout& layout, const Byte* from, Byte* to) {
  for (std::size_t x = 0; x < layout.width; ++x, from += 3, to += 3) {
    to[0] = from[2];
    to[1] = from[1];
    to[2] = from[0];
  }
}

void grey_row(const Layout& layout, const Byte* from, Byte* to) {
  switch (layout.format) {
    case PixelFormat::grey:
    case PixelFormat::nv12: return luma_row(layout, from, 1, 1, to);
    case PixelFormat::yuyv: return luma_row(layout, from, 2, 1, to);
    case PixelFormat::rgb24: return grey_of_rgb_row(layout, from, 0, to);
    case PixelFormat::bgr24: return grey_of_rgb_row(layout, from, 2, to);
    case PixelFormat::mjpeg: return;
  }
}

// @param differences  the row of them that belongs to this one, if they have a plane of their own.
void rgb_row(const Layout& layout, const Byte* from, const Byte* differences, Byte* to) {
  switch (layout.format) {
    case PixelFormat::grey: return luma_row(layout, from, 1, 3, to);
    case PixelFormat::nv12: return nv12_row(layout, from, differences, to);
    case PixelFormat::yuyv: return yuyv_row(layout, from, to);
    case PixelFormat::rgb24: std::memcpy(to, from, 3 * layout.width); return;
    case PixelFormat::bgr24: return swapped_row(layout, from, to);
    case PixelFormat::mjpeg: return;
  }
}

std::size_t even(std::size_t number) { return number + number % 2; }

}  // namespace

std::size_t least_step(const Layout& layout) {
  switch (layout.format) {
    case PixelFormat::grey: return layout.width;
    case PixelFormat::nv12: return even(layout.width);
    case PixelFormat::yuyv: return 2 * even(layout.width);
    case PixelFormat::rgb24:
    case PixelFormat::bgr24: return 3 * layout.width;
    case PixelFormat::mjpeg: return 0;
  }
  return 0;
}

// Some drivers leave out what lies behind the last row.
std::size_t bytes_of_picture(const Layout& layout) {
  if (layout.format == PixelFormat::mjpeg || layout.height == 0) return 0;
  const std::size_t rows = layout.height + (layout.format == PixelFormat::nv12 ? even(layout.height) / 2 : 0);
  return (rows - 1) * layout.step + least_step(layout);
}

bool convert(const Layout& layout, std::span<const std::uint8_t> raw, Channels channels,
             std::span<std::uint8_t> into) {
  const std::size_t row = static_cast<std::size_t>(channels) * layout.width;
  if (layout.format == PixelFormat::mjpeg || layout.step < least_step(layout)) return false;
  if (raw.size() < bytes_of_picture(layout) || into.size() < row * layout.height) return false;
  for (std::size_t y = 0; y < layout.height; ++y) {
    const Byte* const from = raw.data() + y * layout.step;
    Byte* const to = into.data() + y * row;
    if (channels == Channels::grey)
      grey_row(layout, from, to);
    else if (layout.format == PixelFormat::nv12)
      rgb_row(layout, from, raw.data() + (layout.height + y / 2) * layout.step, to);
    else
      rgb_row(layout, from, nullptr, to);
  }
  return true;
}

}  // namespace orca::hw::camera
