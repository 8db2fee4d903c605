// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>

#include "decoders.hpp"

namespace orca::image::detail {
namespace {

// Reads the header's and P2's numbers: white space and #-comments may stand between them.
class Tokens {
 public:
  explicit Tokens(std::string_view bytes) : bytes_(bytes), at_(2) {}

  std::optional<std::size_t> number() {
    skip_blanks();
    const std::size_t start = at_;
    std::size_t value = 0;
    for (; at_ < bytes_.size() && digit(bytes_[at_]) && at_ - start < 9; ++at_)
      value = value * 10 + static_cast<std::size_t>(bytes_[at_] - '0');
    return at_ == start ? std::nullopt : std::optional(value);
  }
  // After the header exactly one white-space character precedes the binary pixels.
  [[nodiscard]] std::string_view pixels() const { return bytes_.substr(std::min(at_ + 1, bytes_.size())); }

 private:
  static bool digit(char c) { return c >= '0' && c <= '9'; }
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skip_blanks() {
    while (at_ < bytes_.size() && (blank(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#')
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      else
        ++at_;
    }
  }

  std::string_view bytes_;
  std::size_t at_;
};

Error damaged_pgm(const std::string& what, const std::string& path) {
  return fail(Code::data_loss, "damaged PGM picture: " + what, path);
}

// Returns the n-th binary pixel; two bytes, high one first, if the largest value needs them.
std::size_t binary_pixel(std::string_view pixels, std::size_t n, bool wide) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(pixels[i]));
  };
  return wide ? byte(2 * n) * 256 + byte(2 * n + 1) : byte(n);
}

// Rounded, as libpng does, so that a picture of 16 bits is the same map in both formats.
std::uint8_t scaled(std::size_t value, std::size_t largest) {
  return static_cast<std::uint8_t>((std::min(value, largest) * 255 + largest / 2) / largest);
}

Status read_text_pixels(Tokens& tokens, std::size_t largest, GreyImage& image, const std::string& path) {
  for (std::uint8_t& pixel : image.grey) {
    const auto value = tokens.number();
    if (!value) return damaged_pgm("fewer pixels than the header announces", path);
    pixel = scaled(*value, largest);
  }
  return ok();
}

Status read_binary_pixels(const Tokens& tokens, std::size_t largest, GreyImage& image,
                          const std::string& path) {
  const bool wide = largest > 255;
  const std::string_view pixels = tokens.pixels();
  if (pixels.size() < image.grey.size() * (wide ? 2 : 1))
    return damaged_pgm("fewer pixels than the header announces", path);
  for (std::size_t i = 0; i < image.grey.size(); ++i)
    image.grey[i] = scaled(binary_pixel(pixels, i, wide), largest);
  return ok();
}

}  // namespace

Result<GreyImage> decode_pgm(std::string_view bytes, const std::string& path, std::size_t most_pixels) {
  Tokens tokens(bytes);
  const auto width = tokens.number();
  const auto height = tokens.number();
  const auto largest = tokens.number();
  if (!width || !height || !largest)
    return damaged_pgm("no width, height and largest value in its header", path);
  if (const Status size = check_size(*width, *height, path, most_pixels); !size) return size.error();
  if (*largest == 0 || *largest > 65535)
    return damaged_pgm("largest value " + std::to_string(*largest) + ", expected 1 to 65535", path);
  // Checked before the allocation, so that a short file cannot reserve memory for a huge picture.
  if (bytes.size() < *width * *height) return damaged_pgm("fewer pixels than the header announces", path);
  GreyImage image{*width, *height, {}};
  image.deep = *largest > 255;
  image.grey.resize(*width * *height);
  const Status read = bytes[1] == '2' ? read_text_pixels(tokens, *largest, image, path)
                                      : read_binary_pixels(tokens, *largest, image, path);
  if (!read) return read.error();
  return image;
}

}  // namespace orca::image::detail
