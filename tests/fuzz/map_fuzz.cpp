// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a map or an error: a YAML file of ROS, or a picture.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "map_header.hpp"
#include "map_picture.hpp"
#include "orca/maps/map_file.hpp"

namespace {

using namespace orca::maps;
using orca::Pose2;

// What is written of a header is read as the same.
void check(const MapHeader& header) {
  const Pose2& corner = header.corner;
  if (!(header.resolution >= kLeastSide && header.resolution <= kMostSide)) std::abort();
  if (!(std::fabs(corner.x) <= kMostDistance && std::fabs(corner.y) <= kMostDistance)) std::abort();
  if (!std::isfinite(corner.yaw)) std::abort();
  const auto again = parse_header(header_text(header), "again.yaml");
  if (!again || again->resolution != header.resolution || !(again->corner == header.corner) ||
      again->image != header.image)
    std::abort();
}

// What is written of a map is read as the same cells.
void check(const orca::image::GreyImage& picture, MapMode mode) {
  if (!check_picture(picture, mode, "fuzz").ok()) return;
  MapHeader header;
  header.resolution = 0.05;
  header.mode = mode;
  const auto map = map_of(picture, header);
  if (map.cells().size() != picture.width * picture.height) std::abort();
  const auto texts = texts_of(map, "again.png");
  if (!texts) std::abort();
  const auto again = orca::image::decode_image(texts->picture, "again.png");
  if (!again || again->grey != picture_of(map).grey) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (orca::image::is_picture(bytes)) {
    const auto picture = orca::image::decode_image(bytes, "fuzz", kMostCells);
    if (!picture) return 0;
    for (const MapMode mode : {MapMode::trinary, MapMode::scale, MapMode::raw}) check(*picture, mode);
    return 0;
  }
  const auto header = parse_header(bytes, "fuzz.yaml");
  if (header) check(*header);
  return 0;
}
