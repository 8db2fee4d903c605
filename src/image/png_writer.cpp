// SPDX-License-Identifier: LGPL-3.0-or-later
#include <png.h>

#include "orca/image/grey_image.hpp"

namespace orca::image {

Result<std::string> encode_png(const GreyImage& image) {
  png_image head{};
  head.version = PNG_IMAGE_VERSION;
  head.width = static_cast<png_uint_32>(image.width);
  head.height = static_cast<png_uint_32>(image.height);
  head.format = PNG_FORMAT_GRAY;
  // First the size is asked for, then the bytes.
  png_alloc_size_t size = 0;
  std::string bytes;
  for (int pass = 0; pass < 2; ++pass) {
    void* const memory = pass == 0 ? nullptr : bytes.data();
    if (png_image_write_to_memory(&head, memory, &size, 0, image.grey.data(), 0, nullptr) == 0)
      return fail(Code::internal, std::string("the picture cannot be made: ") + head.message);
    bytes.resize(size);
  }
  return bytes;
}

}  // namespace orca::image
