// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orca/sim/bitmap.hpp"

namespace orca::sim::detail {

inline constexpr std::size_t kMaxPixels = 100'000'000;

/// Both take the whole file as bytes; `path` only serves the error texts.
[[nodiscard]] Result<GreyImage> decode_png(std::string_view bytes, const std::string& path);
[[nodiscard]] Result<GreyImage> decode_pgm(std::string_view bytes, const std::string& path);

/// Size checks common to the formats.
[[nodiscard]] Status check_size(std::size_t width, std::size_t height, const std::string& path);

}  // namespace orca::sim::detail
