// SPDX-License-Identifier: LGPL-3.0-or-later
#include <png.h>

#include <array>
#include <cmath>

#include "decoders.hpp"
#include "orca/base/portable_math.hpp"

namespace orca::image::detail {
namespace {

// libpng's simplified reader, which never jumps out of our frames; frees its state in every case.
struct PngReader {
  png_image image{};
  PngReader() { image.version = PNG_IMAGE_VERSION; }
  ~PngReader() { png_image_free(&image); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

Error damaged_png(const std::string& what, const std::string& path) {
  return fail(Code::data_loss, "damaged PNG picture: " + what, path);
}

constexpr std::size_t kSignature = 8;  // [bytes] before the first chunk

std::size_t length_at(std::string_view bytes, std::size_t at) {
  std::size_t length = 0;
  for (const char c : bytes.substr(at, 4)) length = length << 8U | static_cast<unsigned char>(c);
  return length;
}

// libpng sets aside as much memory as a chunk claims before it looks whether the file holds that much, so each
// claim is compared with the file first. A chunk is its length, its name of 4 bytes, its content and a check sum.
Status check_chunks(std::string_view bytes, const std::string& path) {
  constexpr std::size_t kAround = 12;  // [bytes] of a chunk beside its content
  std::size_t at = kSignature;
  while (at + 8 <= bytes.size() && bytes.substr(at + 4, 4) != "IEND") {
    const std::size_t length = length_at(bytes, at);
    const std::size_t left = bytes.size() - at;
    if (length + kAround > left)
      return damaged_png("the part at byte " + std::to_string(at) + " should have " +
                             std::to_string(length + kAround) + " bytes, but the file has only " +
                             std::to_string(left) + " more",
                         path);
    at += length + kAround;
  }
  return ok();
}

// One pixel of 8 bits a sample, on the scale of sRGB.
struct Pixel {
  std::uint8_t red, green, blue, alpha;
};

constexpr double kExponent = 2.2;  // of sRGB, as libpng has it, too

double power(double base, double exponent) {
  return base > 0.0 ? portable::exp(exponent * portable::log(base)) : 0.0;
}

std::array<double, 256> table_of_light() {
  std::array<double, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = power(static_cast<double>(i) / 255.0, kExponent);
  return table;
}

// Returns the grey of a pixel that is laid on white. libpng could do this, but it mixes light in steps of 1/255, which are
// coarse where it is dark.
std::uint8_t grey_of(const Pixel& pixel) {
  if (pixel.alpha == 255 && pixel.red == pixel.green && pixel.green == pixel.blue) return pixel.red;
  static const std::array<double, 256> kLight = table_of_light();
  const double light =
      0.2126 * kLight[pixel.red] + 0.7152 * kLight[pixel.green] + 0.0722 * kLight[pixel.blue];
  const double on_white = 1.0 - pixel.alpha / 255.0 * (1.0 - light);
  return static_cast<std::uint8_t>(std::lround(255.0 * power(on_white, 1.0 / kExponent)));
}

void append_greys(const std::vector<std::uint8_t>& samples, bool coloured, bool transparent,
                  GreyImage& result) {
  const std::size_t colours = coloured ? 3 : 1;
  const std::size_t step = colours + (transparent ? 1 : 0);
  result.grey.reserve(samples.size() / step);
  for (std::size_t i = 0; i < samples.size(); i += step) {
    const std::uint8_t alpha = transparent ? samples[i + colours] : std::uint8_t{255};
    const Pixel pixel{samples[i], samples[i + colours / 2], samples[i + colours - 1], alpha};
    result.grey.push_back(grey_of(pixel));
    if (transparent) result.opaque.push_back(alpha);
    result.coloured |= pixel.red != pixel.green || pixel.green != pixel.blue;
  }
}

}  // namespace

Result<GreyImage> decode_png(std::string_view bytes, const std::string& path, std::size_t most_pixels) {
  if (const Status sound = check_chunks(bytes, path); !sound) return sound.error();
  PngReader reader;
  png_image& image = reader.image;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
    return damaged_png(image.message, path);
  if (const Status size = check_size(image.width, image.height, path, most_pixels); !size)
    return size.error();
  const bool coloured = (image.format & PNG_FORMAT_FLAG_COLOR) != 0;
  const bool transparent = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  const bool deep = (image.format & PNG_FORMAT_FLAG_LINEAR) != 0;  // 16 bits in the file
  image.format &= PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_ALPHA;   // 8 bits a sample, no palette
  image.flags |=
      PNG_IMAGE_FLAG_16BIT_sRGB;  // otherwise it takes 16-bit samples without a tag for linear ones
  std::vector<std::uint8_t> samples(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, samples.data(), 0, nullptr) == 0)
    return damaged_png(image.message, path);
  GreyImage result{image.width, image.height, {}};
  result.deep = deep;
  append_greys(samples, coloured, transparent, result);
  return result;
}

}  // namespace orca::image::detail
