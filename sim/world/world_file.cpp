// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/world_file.hpp"

#include "orca/sim/bitmap.hpp"
#include "orca/xml/document.hpp"
#include "world_reader.hpp"

namespace orca::sim {
namespace {

std::optional<WorldModel> read_document(const std::optional<xml::Document>& document,
                                        const std::string& file_name, std::size_t errors_before,
                                        xml::Diagnostics& diagnostics) {
  if (!document) return std::nullopt;
  const xml::Element& root = document->root;
  if (root.name() != "world") {
    diagnostics.error("W001", root.position(),
                      "the root element is <" + root.name() +
                          ">; a world file begins with <world name=\"...\" "
                          "version=\"1\">");
    return std::nullopt;
  }
  WorldModel world = detail::WorldReader(file_name, diagnostics).read(root);
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  return world;
}

std::optional<WorldModel> read_bitmap(const std::string& path, std::optional<double> map_width,
                                      xml::Diagnostics& diagnostics) {
  Result<WorldModel> world = read_bitmap_world(path, {.map_width = map_width, .resolution = {}});
  if (world) return std::move(*world);
  diagnostics.error("W011", {path, 0, 0}, world.error().message);
  return std::nullopt;
}

}  // namespace

std::optional<WorldModel> read_world(const std::string& path, std::optional<double> map_width,
                                     xml::Diagnostics& diagnostics) {
  if (path.ends_with(".png") || path.ends_with(".pgm")) return read_bitmap(path, map_width, diagnostics);
  const std::size_t before = diagnostics.error_count();
  if (map_width)
    diagnostics.error("W013", {path, 0, 0},
                      "map_width is for bitmaps (.png, .pgm); an XML world has its own size. Leave it out");
  return read_document(xml::read_file(path, diagnostics), path, before, diagnostics);
}

std::optional<WorldModel> read_world_text(std::string_view text, const std::string& file_name,
                                          xml::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  return read_document(xml::read_text(text, file_name, diagnostics), file_name, before, diagnostics);
}

}  // namespace orca::sim
