// SPDX-License-Identifier: LGPL-3.0-or-later
#include "image_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace orca::sim {

namespace detail {

Status check_size(std::size_t width, std::size_t height, const std::string& path) {
  if (width == 0 || height == 0) return fail(Code::data_loss, "the picture has no pixels", path);
  if (width > kMaxPixels / height)
    return fail(Code::invalid_argument,
                "the picture has " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels; at most 100 million are read. Scale it down",
                path);
  return ok();
}

}  // namespace detail

Result<GreyImage> read_image(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string bytes;
  if (file) bytes.assign(std::istreambuf_iterator<char>(file), {});
  if (!file || file.bad())
    return fail(Code::not_found, std::string("cannot read the picture: ") + std::strerror(errno), path);
  if (bytes.empty()) return fail(Code::data_loss, "the file is empty; expected a PNG or PGM picture", path);
  if (bytes.starts_with("\x89PNG")) return detail::decode_png(bytes, path);
  if (bytes.starts_with("P5") || bytes.starts_with("P2")) return detail::decode_pgm(bytes, path);
  return fail(Code::invalid_argument, "neither a PNG nor a PGM picture (P2 or P5); convert it to PNG", path);
}

}  // namespace orca::sim
