// SPDX-License-Identifier: LGPL-3.0-or-later
#include <png.h>

#include "image_file.hpp"

namespace orca::sim::detail {
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

}  // namespace

Result<GreyImage> decode_png(std::string_view bytes, const std::string& path) {
  if (const Status sound = check_chunks(bytes, path); !sound) return sound.error();
  PngReader reader;
  if (png_image_begin_read_from_memory(&reader.image, bytes.data(), bytes.size()) == 0)
    return damaged_png(reader.image.message, path);
  if (const Status size = check_size(reader.image.width, reader.image.height, path); !size)
    return size.error();
  reader.image.format = PNG_FORMAT_GRAY;
  GreyImage result{reader.image.width, reader.image.height, {}};
  result.grey.resize(result.width * result.height);
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&reader.image, &white, result.grey.data(), 0, nullptr) == 0)
    return damaged_png(reader.image.message, path);
  return result;
}

}  // namespace orca::sim::detail
