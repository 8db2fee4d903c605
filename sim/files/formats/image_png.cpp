// SPDX-License-Identifier: LGPL-3.0-or-later
#include <png.h>

#include "image_file.hpp"

namespace orca::sim::detail {
namespace {

// libpng's simplified reader, which never jumps out of our frames; frees its state in every case.
struct Reader {
  png_image image{};
  Reader() { image.version = PNG_IMAGE_VERSION; }
  ~Reader() { png_image_free(&image); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

Error damaged(const Reader& reader, const std::string& path) {
  return fail(Code::data_loss, std::string("damaged PNG picture: ") + reader.image.message, path);
}

}  // namespace

Result<GreyImage> decode_png(std::string_view bytes, const std::string& path) {
  Reader reader;
  if (png_image_begin_read_from_memory(&reader.image, bytes.data(), bytes.size()) == 0)
    return damaged(reader, path);
  if (const Status size = check_size(reader.image.width, reader.image.height, path); !size)
    return size.error();
  reader.image.format = PNG_FORMAT_GRAY;
  GreyImage result{reader.image.width, reader.image.height, {}};
  result.grey.resize(result.width * result.height);
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&reader.image, &white, result.grey.data(), 0, nullptr) == 0)
    return damaged(reader, path);
  return result;
}

}  // namespace orca::sim::detail
