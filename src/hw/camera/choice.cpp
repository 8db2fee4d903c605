// SPDX-License-Identifier: LGPL-3.0-or-later
#include "choice.hpp"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <tuple>

#include "orca/base/text.hpp"

namespace orca::hw::camera {
namespace {

constexpr std::uint32_t kMostFormats = 100;   // that a camera may list
constexpr std::uint32_t kMostPixels = 16384;  // in a row, and rows
constexpr double kEnough = 0.95;              // of the rate that is wished

struct Known {
  std::uint32_t number;
  PixelFormat format;
  int grey_cost, rgb_cost;  // order in which formats are preferred, the smallest first
};
constexpr std::array kKnown{
    Known{V4L2_PIX_FMT_GREY, PixelFormat::grey, 0, 6},   Known{V4L2_PIX_FMT_NV12, PixelFormat::nv12, 1, 3},
    Known{V4L2_PIX_FMT_YUYV, PixelFormat::yuyv, 2, 2},   Known{V4L2_PIX_FMT_RGB24, PixelFormat::rgb24, 3, 0},
    Known{V4L2_PIX_FMT_BGR24, PixelFormat::bgr24, 4, 1}, Known{V4L2_PIX_FMT_MJPEG, PixelFormat::mjpeg, 5, 4},
    Known{V4L2_PIX_FMT_JPEG, PixelFormat::mjpeg, 5, 4}};

const Known* known(std::uint32_t number) {
  const auto* const found = std::ranges::find(kKnown, number, &Known::number);
  return found == kKnown.end() ? nullptr : found;
}

std::vector<std::uint32_t> formats_of(VideoCalls& calls, int descriptor) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < kMostFormats; ++i) {
    v4l2_fmtdesc about{};
    about.index = i;
    about.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (calls.control(descriptor, VIDIOC_ENUM_FMT, &about) != 0) break;
    all.push_back(about.pixelformat);
  }
  return all;
}

Error cannot_be_read(const std::vector<std::uint32_t>& formats) {
  std::vector<std::string> given;
  for (const std::uint32_t number : formats) given.push_back(name_of_format(number));
  std::vector<std::string> read;
  for (const Known& each : kKnown) read.push_back(name_of_format(each.number));
  return fail(Code::invalid_argument,
              "the camera gives " + listed(given) + ", and this driver reads " + listed(read));
}

// Pictures of luma alone are said to be of limited range unless a driver knows better, which most do not: cameras fill all 256 values.
bool is_full_range(const v4l2_pix_format& pixels, PixelFormat format) {
  if (pixels.quantization == V4L2_QUANTIZATION_FULL_RANGE) return true;
  if (pixels.quantization == V4L2_QUANTIZATION_LIM_RANGE) return false;
  return format == PixelFormat::grey || pixels.colorspace == V4L2_COLORSPACE_JPEG;
}

// A driver takes what it can do that is nearest.
// @return errno; EINVAL also if it gives something that no camera can mean.
int set_format(VideoCalls& calls, int descriptor, const Known& wanted, const Wish& wish, Mode& mode) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_pix_format& pixels = format.fmt.pix;
  pixels.width = static_cast<std::uint32_t>(wish.width);
  pixels.height = static_cast<std::uint32_t>(wish.height);
  pixels.pixelformat = wanted.number;
  pixels.field = V4L2_FIELD_NONE;
  if (const int reason = calls.control(descriptor, VIDIOC_S_FMT, &format); reason != 0) return reason;
  const bool makes_sense = pixels.pixelformat == wanted.number && pixels.width > 0 && pixels.height > 0 &&
                           pixels.width <= kMostPixels && pixels.height <= kMostPixels;
  if (!makes_sense) return EINVAL;
  mode.format = name_of_format(wanted.number);
  mode.layout = {wanted.format, pixels.width, pixels.height, 0, is_full_range(pixels, wanted.format)};
  mode.layout.step = std::max<std::size_t>(pixels.bytesperline, least_step(mode.layout));
  return 0;
}

// Not all drivers know of rates.
std::optional<double> set_rate(VideoCalls& calls, int descriptor, double rate) {
  v4l2_streamparm param{};
  param.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_fract& period = param.parm.capture.timeperframe;
  period = {1000, static_cast<std::uint32_t>(std::lround(1000.0 * rate))};
  if (calls.control(descriptor, VIDIOC_S_PARM, &param) != 0) return std::nullopt;
  if (period.numerator == 0 || period.denominator == 0) return std::nullopt;
  return static_cast<double>(period.denominator) / period.numerator;
}

int set_mode(VideoCalls& calls, int descriptor, const Known& wanted, const Wish& wish, Mode& mode) {
  const int reason = set_format(calls, descriptor, wanted, wish, mode);
  if (reason == 0) mode.rate = set_rate(calls, descriptor, wish.rate);
  return reason;
}

// The smaller, the better.
auto badness(const Mode& mode, const Wish& wish, const Known& format) {
  const auto off = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
  const std::size_t size = off(mode.layout.width, wish.width) + off(mode.layout.height, wish.height);
  const double slow = std::max(0.0, kEnough * wish.rate - mode.rate.value_or(wish.rate));
  return std::tuple(size, slow, wish.channels == Channels::grey ? format.grey_cost : format.rgb_cost);
}

}  // namespace

std::string name_of_format(std::uint32_t number) {
  std::string name;
  for (unsigned shift = 0; shift < 32; shift += 8) name += static_cast<char>(number >> shift & 0x7fU);
  while (name.ends_with(' ')) name.pop_back();
  return printable(name);
}

Result<Mode> choose_mode(VideoCalls& calls, int descriptor, const Wish& wish, bool& is_busy) {
  const std::vector<std::uint32_t> formats = formats_of(calls, descriptor);
  const Known* best = nullptr;
  Mode chosen;
  int refusal = 0;
  for (const std::uint32_t number : formats) {
    const Known* const format = known(number);
    if (format == nullptr) continue;
    Mode mode;
    const int reason = set_mode(calls, descriptor, *format, wish, mode);
    if (reason != 0) refusal = reason;
    if (reason != 0 || (best != nullptr && badness(mode, wish, *format) >= badness(chosen, wish, *best)))
      continue;
    best = format;
    chosen = mode;
  }
  if (best != nullptr)
    refusal = set_mode(calls, descriptor, *best, wish, chosen);  // others were tried after it
  is_busy = refusal == EBUSY;
  if (refusal == 0) return best != nullptr ? Result<Mode>(chosen) : cannot_be_read(formats);
  return fail(refusal == ENODEV ? Code::not_found : Code::unavailable,
              std::string("the camera takes no format: ") + std::strerror(refusal));
}

}  // namespace orca::hw::camera
