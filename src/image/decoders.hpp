// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orca/image/grey_image.hpp"

namespace orca::image::detail {

inline constexpr std::size_t kMaxPixels = 100'000'000;

/// Decode an image from the bytes of the whole file; `path` only appears in errors.
[[nodiscard]] Result<GreyImage> decode_png(std::string_view bytes, const std::string& path);
[[nodiscard]] Result<GreyImage> decode_pgm(std::string_view bytes, const std::string& path);

/// Checks the size of an image, in pixels, for all formats.
[[nodiscard]] Status check_size(std::size_t width, std::size_t height, const std::string& path);

}  // namespace orca::image::detail
