// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <filesystem>

#include "decoders.hpp"
#include "orca/base/input_file.hpp"

namespace orca::image {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kPng = "\x89PNG";

struct Format {
  std::string_view start;
  const char* name;
};
constexpr std::array kForeign{Format{"\xFF\xD8\xFF", "JPEG"},
                              Format{"GIF8", "GIF"},
                              Format{"II*\0"sv, "TIFF"},
                              Format{"MM\0*"sv, "TIFF"},
                              Format{"%PDF", "PDF"},
                              Format{"P6", "PPM"},
                              Format{"P3", "PPM"},
                              Format{"P1", "PBM"},
                              Format{"P4", "PBM"}};

}  // namespace

bool is_picture(std::string_view bytes) {
  return bytes.starts_with(kPng) || bytes.starts_with("P5") || bytes.starts_with("P2");
}

std::string foreign_picture(std::string_view bytes) {
  for (const Format& format : kForeign)
    if (bytes.starts_with(format.start)) return format.name;
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "WebP";
  constexpr std::size_t kReserved = 6;  // four zero bytes in the head of each BMP
  if (bytes.starts_with("BM") && bytes.substr(0, kReserved + 4).ends_with("\0\0\0\0"sv)) return "BMP";
  return "";
}

std::string advice_about(const std::string& format, const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  return "this is a " + format +
         " file; PNG and PGM pictures are read: convert it, for instance with \"convert " + name.string() +
         " " + std::filesystem::path(name).replace_extension(".png").string() + "\"";
}

Status detail::check_size(std::size_t width, std::size_t height, const std::string& path,
                          std::size_t most_pixels) {
  if (width == 0 || height == 0) return fail(Code::data_loss, "the picture has no pixels", path);
  if (width > most_pixels / height)
    return fail(Code::invalid_argument,
                "the picture has " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels; at most " + std::to_string(most_pixels / 1'000'000) +
                    " million are read. Scale it down",
                path);
  return ok();
}

namespace {

constexpr std::size_t kMaxImageBytes = 1'000'000'000;  // a text of 100 million pixels has half of that

}  // namespace

Result<GreyImage> read_image(const std::string& path, std::size_t most_pixels) {
  const Result<std::string> read = read_input_file(path, kMaxImageBytes);
  if (!read) return fail(read.error().code, "cannot read the picture: " + read.error().message, path);
  return decode_image(*read, path, most_pixels);
}

Result<GreyImage> decode_image(std::string_view bytes, const std::string& path, std::size_t most_pixels) {
  if (bytes.empty()) return fail(Code::data_loss, "the file is empty; expected a PNG or PGM picture", path);
  if (bytes.starts_with(kPng)) return detail::decode_png(bytes, path, most_pixels);
  if (is_picture(bytes)) return detail::decode_pgm(bytes, path, most_pixels);
  if (const std::string format = foreign_picture(bytes); !format.empty())
    return fail(Code::invalid_argument, advice_about(format, path), path);
  return fail(Code::invalid_argument, "neither a PNG nor a PGM picture (P2 or P5); convert it to PNG", path);
}

}  // namespace orca::image
