// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orca/sim/bitmap.hpp"

namespace orca::sim::detail {

inline constexpr std::size_t kMaxPixels = 100'000'000;

/// Returns the name of a format of pictures that is known by its first bytes but not read, such as "JPEG"; empty: none.
[[nodiscard]] std::string foreign_picture(std::string_view bytes);
/// Returns whether these are the first bytes of a picture that read_image() reads.
[[nodiscard]] bool is_picture(std::string_view bytes);
/// Returns what to do with a picture of such a format.
[[nodiscard]] std::string advice_about(const std::string& format, const std::string& path);

/// Decode an image from the bytes of the whole file; `path` only appears in errors.
[[nodiscard]] Result<GreyImage> decode_png(std::string_view bytes, const std::string& path);
[[nodiscard]] Result<GreyImage> decode_pgm(std::string_view bytes, const std::string& path);

/// Checks the size of an image, in pixels, for all formats.
[[nodiscard]] Status check_size(std::size_t width, std::size_t height, const std::string& path);

}  // namespace orca::sim::detail
