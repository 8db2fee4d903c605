// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orca/image/grey_image.hpp"

namespace orca::image::detail {

/// Decode an image from the bytes of the whole file; `path` only appears in errors.
[[nodiscard]] Result<GreyImage> decode_png(std::string_view bytes, const std::string& path,
                                           std::size_t most_pixels);
[[nodiscard]] Result<GreyImage> decode_pgm(std::string_view bytes, const std::string& path,
                                           std::size_t most_pixels);

/// Checks the size of an image, in pixels, for all formats.
[[nodiscard]] Status check_size(std::size_t width, std::size_t height, const std::string& path,
                                std::size_t most_pixels);

}  // namespace orca::image::detail
