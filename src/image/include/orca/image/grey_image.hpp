// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::image {

/// A grey image; `grey` holds rows from the top of the picture down, 0 black to 255 white, on the scale of sRGB.
struct GreyImage {
  std::size_t width = 0;   ///< [pixels]
  std::size_t height = 0;  ///< [pixels]
  std::vector<std::uint8_t> grey;
  std::vector<std::uint8_t>
      opaque{};           ///< Per pixel: 0 fully transparent to 255 opaque; empty: all are opaque.
  bool coloured = false;  ///< Some pixel of the file is not grey.
  bool deep = false;      ///< The file has more than 8 bits a sample.
};

inline constexpr std::size_t kMostPixels = 100'000'000;  ///< that are read unless the caller wants fewer.

/// Reads a PNG or PGM (P2, P5) file, distinguished by its first bytes.
///
/// The grey of a PNG is what a viewer shows. An `sRGB` tag is followed, else a `gAMA` tag; without either, samples of
/// any depth are sRGB. Colours count by their luminance, and transparent parts are laid on white; both mix light, not
/// numbers. Where a conversion is needed, sRGB stands for `gAMA` 1 / 2.2, as the standard says. Colour profiles are
/// ignored. The values of a PGM, which has no tags, are proportional to the grey.
///
/// @source  W3C, Portable Network Graphics (PNG) Specification, 2nd edition, 11.3.3.2 and 11.3.3.5, 13.13 to 13.16.
/// @param most_pixels  that it may have; a larger one is refused before it takes memory.
/// @errors  not_found if the file cannot be opened; data_loss if it is damaged; invalid_argument if it is
///          neither format or too large.
/// @thread  any.
[[nodiscard]] Result<GreyImage> read_image(const std::string& path, std::size_t most_pixels = kMostPixels);

/// Reads such a picture from the bytes of the whole file; `path` only appears in errors.
[[nodiscard]] Result<GreyImage> decode_image(std::string_view bytes, const std::string& path,
                                             std::size_t most_pixels = kMostPixels);

/// Returns the bytes of a PNG file of 8 bits a pixel. What it does not show stays out: `opaque` and the file's facts.
/// @pre  grey.size() = width * height > 0.
/// @errors  internal with libpng's reason.
/// @thread  pure function; any thread.
[[nodiscard]] Result<std::string> encode_png(const GreyImage& image);

/// Returns whether these are the first bytes of a picture that read_image() reads.
[[nodiscard]] bool is_picture(std::string_view bytes);

/// Returns the name of a format of pictures that is known by its first bytes but not read, such as "JPEG"; empty: none.
[[nodiscard]] std::string foreign_picture(std::string_view bytes);

/// Returns what to do with a picture of such a format.
[[nodiscard]] std::string advice_about(const std::string& format, const std::string& path);

}  // namespace orca::image
