// SPDX-License-Identifier: LGPL-3.0-or-later
#include "objects.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::sim {
namespace {

constexpr std::size_t kBytes = 3;  // Per pixel.
constexpr Colour kCeiling{228, 229, 231};
constexpr Colour kFloor{112, 105, 97};

}  // namespace

// The pixels are written row by row, as they lie in memory; each column remembers which run the present row is in.
void fill(idl::Image& object, const CameraShot& shot, const Camera& camera) {
  object.encoding(idl::RGB8);
  object.width(static_cast<std::uint32_t>(camera.width));
  object.height(static_cast<std::uint32_t>(camera.height));
  object.step(static_cast<std::uint32_t>(kBytes * camera.width));
  object.focal_length(camera.focal_length());
  object.pose(level_pose(shot.X_RB * camera.center, camera.link_height, shot.stamp));
  object.data().resize_for_overwrite(kBytes * camera.width * camera.height);
  std::vector<std::size_t> runs = shot.starts;
  std::uint8_t* pixel = object.data().data();
  for (std::size_t row = 0; row < camera.height; ++row) {
    const Colour background = 2 * row < camera.height ? kCeiling : kFloor;
    for (std::size_t column = 0; column < camera.width; ++column) {
      std::size_t& run = runs[column];
      while (shot.runs[run].end <= row) ++run;
      const Colour colour = shot.runs[run].colour.value_or(background);
      *pixel++ = colour.red;
      *pixel++ = colour.green;
      *pixel++ = colour.blue;
    }
  }
}

}  // namespace orca::sim
