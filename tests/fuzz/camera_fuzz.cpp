// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of cameras: whatever bytes come, in whatever size, they are refused or become a whole picture, and a picture that is
// whole still is after them. The first bytes choose the format and the size.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "orca/hw/camera/jpeg_decoder.hpp"
#include "orca/hw/camera/pixels.hpp"

namespace {

using namespace orca::hw::camera;
using Input = std::span<const std::uint8_t>;

constexpr std::size_t kHead = 4;
constexpr std::uint8_t kUntouched = 0xa5;

// A room for a picture, and a byte behind it that nobody may write.
std::vector<std::uint8_t> room(std::size_t width, std::size_t height, Channels channels) {
  std::vector<std::uint8_t> bytes(width * height * static_cast<std::size_t>(channels) + 1);
  bytes.back() = kUntouched;
  return bytes;
}

std::span<std::uint8_t> inside(std::vector<std::uint8_t>& bytes) {
  return std::span(bytes).first(bytes.size() - 1);
}

void check(bool holds) {
  if (!holds) std::abort();
}

void try_pixels(const Layout& layout, Input raw, Channels channels) {
  std::vector<std::uint8_t> into = room(layout.width, layout.height, channels);
  const bool is_enough = layout.step >= least_step(layout) && layout.format != PixelFormat::mjpeg &&
                         raw.size() >= bytes_of_picture(layout);
  check(convert(layout, raw, channels, inside(into)) == is_enough);
  check(into.back() == kUntouched);
}

void try_jpeg(Input bytes, std::size_t width, std::size_t height, Channels channels) {
  static JpegDecoder decoder;
  std::vector<std::uint8_t> into = room(width, height, channels);
  const orca::Status decoded = decoder.decode(bytes, width, height, channels, inside(into));
  check(into.back() == kUntouched);
  std::vector<std::uint8_t> again = room(width, height, channels);
  check(decoder.decode(bytes, width, height, channels, inside(again)).ok() == decoded.ok());
  check(!decoded.ok() || into == again);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kHead) return 0;
  const Input rest(data + kHead, size - kHead);
  const Channels channels = data[0] % 2 == 0 ? Channels::rgb : Channels::grey;
  Layout layout;
  layout.format = static_cast<PixelFormat>(data[0] / 2 % 6);
  layout.full_range = data[0] >= 128;
  layout.width = data[1];
  layout.height = data[2];
  layout.step = least_step(layout) + data[3] % 16;
  if (layout.step > 0 && data[3] >= 240) --layout.step;
  try_pixels(layout, rest, channels);
  if (data[1] > 0 && data[2] > 0) try_jpeg(rest, data[1], data[2], channels);
  return 0;
}
