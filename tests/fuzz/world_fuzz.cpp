// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a world or errors: an XML world, or a picture in one of the formats that a map may have.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "orca/image/grey_image.hpp"
#include "orca/sim/world_file.hpp"

namespace {

// Checks that every obstacle of a world that was read has finite, ordered bounds.
void check(const orca::sim::WorldModel& world) {
  for (const orca::sim::Obstacle& obstacle : world.obstacles) {
    const orca::sim::Bounds bounds = bounds_of(obstacle.shape);
    if (!std::isfinite(bounds.low.x + bounds.low.y + bounds.high.x + bounds.high.y)) std::abort();
    if (bounds.low.x > bounds.high.x || bounds.low.y > bounds.high.y) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (orca::image::is_picture(bytes)) {
    static_cast<void>(orca::image::decode_image(bytes, "fuzz.png"));
    return 0;
  }
  orca::xml::Diagnostics diagnostics;
  // In a folder that does not exist, so that it finds no pictures.
  const auto world = orca::sim::read_world_text(bytes, "/no/such/folder/fuzz.xml", diagnostics);
  if (world.has_value() == diagnostics.has_errors()) std::abort();
  if (world) check(*world);
  return 0;
}
