// SPDX-License-Identifier: LGPL-3.0-or-later
#include "image_file.hpp"

#include "orca/base/input_file.hpp"

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

namespace {

constexpr std::size_t kMaxImageBytes = 1'000'000'000;  // a text of 100 million pixels has half of that

}  // namespace

Result<GreyImage> read_image(const std::string& path) {
  const Result<std::string> read = read_input_file(path, kMaxImageBytes);
  if (!read) return fail(read.error().code, "cannot read the picture: " + read.error().message, path);
  const std::string& bytes = *read;
  if (bytes.empty()) return fail(Code::data_loss, "the file is empty; expected a PNG or PGM picture", path);
  if (bytes.starts_with("\x89PNG")) return detail::decode_png(bytes, path);
  if (bytes.starts_with("P5") || bytes.starts_with("P2")) return detail::decode_pgm(bytes, path);
  return fail(Code::invalid_argument, "neither a PNG nor a PGM picture (P2 or P5); convert it to PNG", path);
}

}  // namespace orca::sim
