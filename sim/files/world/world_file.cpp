// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/world_file.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "codes.hpp"
#include "cylinder_file.hpp"
#include "orca/base/input_file.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"
#include "world_reader.hpp"

namespace orca::sim {
namespace {

namespace world_codes = detail::world_codes;

enum class Format { xml, bitmap, cylinders };

Format format_of(std::string file) {
  std::ranges::transform(file, file.begin(), [](unsigned char c) { return std::tolower(c); });
  if (file.ends_with(".png") || file.ends_with(".pgm")) return Format::bitmap;
  return file.ends_with(".csv") || file.ends_with(".csv.gz") ? Format::cylinders : Format::xml;
}

// Returns the beginning of a file; nothing of one that cannot be read, which is reported when all of it is read.
std::string beginning_of(const std::string& file) {
  constexpr std::size_t kEnough = 4096;
  const Result<std::string> bytes = read_input_file(file, kEnough);
  return bytes ? *bytes : "";
}

// Returns the value of a key in the first lines of a YAML file, without quotes; empty: it is not there.
std::string yaml_value(const std::string& text, const std::string& key) {
  const std::size_t at = text.starts_with(key + ":") ? 0 : text.find("\n" + key + ":");
  if (at == std::string::npos) return "";
  const std::size_t from = text.find(':', at) + 1;
  std::string value(xml::trimmed(text.substr(from, text.find('\n', from) - from)));
  std::erase_if(value, [](char c) { return c == '"' || c == '\''; });
  return value;
}

// Returns what to do with a file that is known but not read as a world; empty: it may be one.
std::string advice_about_other(const std::string& file, const std::string& bytes) {
  if (const std::string format = image::foreign_picture(bytes); !format.empty())
    return image::advice_about(format, file);
  const std::string image = yaml_value(bytes, "image"), resolution = yaml_value(bytes, "resolution");
  if (image.empty() || resolution.empty()) return "";
  const std::string negate = yaml_value(bytes, "negate");
  const bool is_negated = negate == "1" || negate == "true" || negate == "True";
  return "this is the YAML file of a map of ROS; name its picture instead, with world=\"" +
         (std::filesystem::path(file).parent_path() / image).lexically_normal().string() +
         "\" and map_resolution=\"" + resolution +
         " m\". Its origin is not used: (0, 0) is the lower left corner; what is not known counts as free" +
         (is_negated ? "; negate is set, so exchange black and white in the picture first" : "");
}

// The parts of "FILE#N". The name of a file may contain a # itself, unless the part before it is one of our
// files.
struct Reference {
  std::string file;
  std::optional<std::uint64_t> number;
};

std::optional<Reference> reference_of(const std::string& path, xml::Diagnostics& diagnostics) {
  const std::size_t mark = path.rfind('#');
  const std::string file = path.substr(0, mark);
  if (mark == std::string::npos || (format_of(file) == Format::xml && !file.ends_with(".xml")))
    return Reference{path, {}};
  const std::string text = path.substr(mark + 1);
  const Result<std::int64_t> number = xml::parse_integer(text);
  if (number && *number >= 0) return Reference{file, static_cast<std::uint64_t>(*number)};
  diagnostics.error(
      world_codes::kNumber, {file, 0, 0},
      "\"#" + text + "\" does not choose a world: write a whole number after the #, e.g. \"" + file + "#1\"");
  return std::nullopt;
}

std::optional<WorldModel> read_document(const std::optional<xml::Document>& document,
                                        const std::string& file_name, std::optional<std::uint64_t> seed,
                                        std::size_t errors_before, xml::Diagnostics& diagnostics) {
  if (!document) return std::nullopt;
  const xml::Element& root = document->root;
  if (root.name() != "world") {
    diagnostics.error(world_codes::kWrongRoot, root.position(),
                      "the root element is <" + root.name() +
                          ">; a world file begins with <world name=\"...\" "
                          "version=\"1\">");
    return std::nullopt;
  }
  WorldModel world = detail::WorldReader(file_name, seed, diagnostics).read(root);
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  return world;
}

// Reads the picture even if its number or scale is wrong, so that all errors come at once.
std::optional<WorldModel> read_bitmap(const Reference& from, const BitmapScale& scale,
                                      xml::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  const auto refuse = [&](const char* code, const std::string& message) {
    diagnostics.error(code, {from.file, 0, 0}, message);
    return std::nullopt;
  };
  if (from.number) refuse(world_codes::kNumber, "a picture holds one world; leave \"#N\" out");
  const Result<GreyImage> image = image::read_image(from.file);
  if (!image) return refuse(world_codes::kUnreadable, image.error().message);
  if (const auto doubt = doubt_about(*image))
    diagnostics.warning(world_codes::kLightGrey, {from.file, 0, 0}, *doubt);
  const Result<double> pixel = pixel_size(scale, *image);
  if (!pixel) refuse(world_codes::kScaleOfPicture, pixel.error().message);
  Result<WorldModel> world =
      bitmap_world(*image, pixel ? *pixel : 1.0, std::filesystem::path(from.file).stem().string());
  if (!world) return refuse(world_codes::kUnreadable, world.error().message);
  if (diagnostics.error_count() != before) return std::nullopt;
  return std::move(*world);
}

void refuse_scale(const std::string& file, const BitmapScale& scale, xml::Diagnostics& diagnostics) {
  if (!scale.map_width && !scale.resolution) return;
  const std::string name = scale.map_width ? "map_width" : "map_resolution";
  diagnostics.error(world_codes::kScaleWithoutPicture, {file, 0, 0},
                    name + " is for bitmaps (.png, .pgm); this world has its own size. Leave it out");
}

}  // namespace

std::optional<WorldModel> read_world(const std::string& path, const BitmapScale& scale,
                                     xml::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  const auto from = reference_of(path, diagnostics);
  if (!from) return std::nullopt;
  const std::string beginning = beginning_of(from->file);
  if (const std::string advice = advice_about_other(from->file, beginning); !advice.empty()) {
    diagnostics.error(world_codes::kOtherFormat, {from->file, 0, 0}, advice);
    return std::nullopt;
  }
  const Format format = image::is_picture(beginning) ? Format::bitmap : format_of(from->file);
  if (format == Format::bitmap) return read_bitmap(*from, scale, diagnostics);
  refuse_scale(from->file, scale, diagnostics);
  if (format == Format::cylinders) {
    auto world = detail::read_cylinder_world(from->file, from->number, diagnostics);
    return diagnostics.error_count() == before ? std::move(world) : std::nullopt;
  }
  return read_document(xml::read_file(from->file, diagnostics), from->file, from->number, before,
                       diagnostics);
}

Result<WorldModel> read_world(const std::string& path, std::vector<std::string>& warnings) {
  constexpr std::size_t kShown = 20;
  xml::Diagnostics diagnostics;
  std::optional<WorldModel> world = read_world(path, {}, diagnostics);
  std::string errors;
  std::size_t count = 0;
  for (const xml::Diagnostic& diagnostic : diagnostics.sorted()) {
    if (diagnostic.severity == xml::Severity::warning) {
      warnings.push_back(diagnostic.text());
    } else if (++count <= kShown) {
      errors += (count > 1 ? "; " : "") + diagnostic.text();
    }
  }
  if (count > kShown) errors += "; and " + std::to_string(count - kShown) + " more";
  if (!world || count > 0) return fail(Code::invalid_argument, errors);
  return std::move(*world);
}

std::optional<WorldModel> read_world_text(std::string_view text, const std::string& file_name,
                                          xml::Diagnostics& diagnostics, std::optional<std::uint64_t> seed) {
  const std::size_t before = diagnostics.error_count();
  return read_document(xml::read_text(text, file_name, diagnostics), file_name, seed, before, diagnostics);
}

}  // namespace orca::sim
